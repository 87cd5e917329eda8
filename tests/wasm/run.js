// Runs a script with the parts of the playground in Node, and prints what it returns as JSON:
// node run.js MODULE SCRIPT. The script sees `engine`, and the classes of the parts.

const fs = require("node:fs");
const path = require("node:path");

const WEB = path.join(__dirname, "..", "..", "tools", "playground", "web");
const PARTS = ["engine.js", "live_rows.js", "recorder.js", "situations.js"];
const NAMES = ["Engine", "LiveRows", "Recorder", "situationText", "readSituation"];

async function main() {
  const [module, script] = process.argv.slice(2);
  const source = PARTS.map((name) => fs.readFileSync(path.join(WEB, name), "utf8")).join("\n");
  const parts = new Function(`${source}\nreturn { ${NAMES.join(", ")} };`)();
  const engine = await parts.Engine.start(fs.readFileSync(module));
  const base64 = (numbers) => Buffer.from(numbers.buffer, numbers.byteOffset, numbers.byteLength).toString("base64");
  const read = (file) => new Uint8Array(fs.readFileSync(file));
  const given = { ...parts, engine, base64, read };
  const run = new Function(...Object.keys(given), `return (async () => { ${script} })();`);
  process.stdout.write(JSON.stringify((await run(...Object.values(given))) ?? null));
}

main().catch((error) => {
  process.stderr.write(`${error.stack}\n`);
  process.exitCode = 1;
});
