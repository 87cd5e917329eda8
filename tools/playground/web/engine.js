// Matches of the WebAssembly module; crates/rsim-wasm documents its exports.

const ROWS = { state: 0, blue: 1, yellow: 2, commands: 3, game: 4 };

/** The module, with texts and rows in place of addresses. */
class Engine {
  static async start(bytes) {
    const { instance } = await WebAssembly.instantiate(bytes, {});
    return new Engine(instance.exports);
  }

  constructor(exports) {
    this.exports = exports;
    exports.names();
    this.names = JSON.parse(this.text());
  }

  /** Bytes of the last output, a copy. */
  bytes() {
    const { memory, output, output_length: length } = this.exports;
    return new Uint8Array(memory.buffer, output(), length()).slice();
  }

  text() {
    return new TextDecoder().decode(this.bytes());
  }

  numbers() {
    return new Float32Array(this.bytes().buffer);
  }

  /** Write bytes or a text where the module reads them, and return their number. */
  give(content) {
    const bytes = typeof content === "string" ? new TextEncoder().encode(content) : content;
    const start = this.exports.input(bytes.length);
    new Uint8Array(this.exports.memory.buffer, start, bytes.length).set(bytes);
    return bytes.length;
  }

  /** Call a function that may fail. */
  call(name, ...numbers) {
    const result = this.exports[name](...numbers);
    if (result < 0) throw new Error(this.text());
    return result;
  }

  golden() {
    this.call("golden");
    return this.text().split("\n");
  }

  newMatch(setup) {
    return new Match(this, this.call("create", this.give(JSON.stringify(setup))));
  }
}

/** One match of the module. */
class Match {
  constructor(engine, handle) {
    this.engine = engine;
    this.handle = handle;
  }

  remove() {
    this.engine.call("remove", this.handle);
  }

  setIdle(team) {
    this.engine.call("set_side", this.handle, team, -1, 0);
  }

  setScripted(team, skill) {
    this.engine.call("set_side", this.handle, team, skill, 0);
  }

  setPolicy(team, file) {
    this.engine.call("set_side", this.handle, team, 0, this.engine.give(file));
  }

  /** Give a robot to a person; null gives it back to its side. */
  control(robot, controls) {
    this.engine.call("control", this.handle, robot, this.engine.give(JSON.stringify(controls)));
  }

  /** Advance by a control step; true if the referee decided something. */
  step() {
    return this.engine.call("step", this.handle) > 0;
  }

  change(conditions) {
    this.engine.call("change", this.handle, this.engine.give(JSON.stringify(conditions)));
  }

  /** Move the ball (0) or a robot (1 and more); false where it cannot be. */
  move(body, x, y, vx = 0, vy = 0) {
    return this.engine.exports.move_body(this.handle, body, x, y, vx, vy) >= 0;
  }

  row(name) {
    this.engine.call("row", this.handle, ROWS[name]);
    return this.engine.numbers();
  }

  /** All numbers of the situation: bodies and referee. */
  situation() {
    const parts = [this.row("state"), this.row("game")];
    const all = new Float32Array(parts[0].length + parts[1].length);
    all.set(parts[0]);
    all.set(parts[1], parts[0].length);
    return all;
  }

  resume(situation) {
    const bytes = new Uint8Array(situation.buffer, situation.byteOffset, situation.byteLength);
    this.engine.call("resume", this.handle, this.engine.give(bytes));
  }

  /** State of the referee in words and numbers. */
  report() {
    this.engine.call("describe", this.handle);
    return JSON.parse(this.engine.text());
  }

  configuration() {
    this.engine.call("configuration", this.handle);
    return this.engine.text();
  }

  /** Observation of a robot of a network's team, then the means of its action. */
  decision(robot) {
    this.engine.call("decision", this.handle, robot);
    return this.engine.numbers();
  }
}
