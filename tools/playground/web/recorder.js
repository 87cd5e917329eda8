// Writer of replay files; docs/replays.md describes the format, reader.js reads it.

const FILE_MAGIC = [0x89, 0x52, 0x53, 0x52, 0x0d, 0x0a, 0x1a, 0x0a];
const FILE_VERSION = 4;
const FILE_START = 56; // bytes before the header
const MOST_FRAMES = 12000; // five minutes

async function deflate(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new CompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Planes of the bytes of zigzag differences, column by column. */
function encodeColumns(rows, steps) {
  const count = rows.length * steps.length;
  const bytes = new Uint8Array(4 * count);
  steps.forEach((step, column) => {
    let last = 0;
    rows.forEach((row, frame) => {
      const whole = Math.round(row[column] / step);
      const difference = (whole - last) | 0;
      const zigzag = (difference << 1) ^ (difference >> 31);
      const at = column * rows.length + frame;
      for (let plane = 0; plane < 4; plane++) bytes[plane * count + at] = zigzag >>> (8 * plane);
      last = whole;
    });
  });
  return bytes;
}

/** Keeps the last frames of a match. */
class Recorder {
  constructor(names, steps, robots) {
    this.names = names;
    this.steps = steps;
    this.robots = robots;
    this.clear();
  }

  clear() {
    this.rows = [];
    this.commands = [];
    this.goals = [];
    this.first = 0; // number of the first frame that is kept
  }

  /** Add a frame: its row, headings without jumps, commands that led to it, teams that scored. */
  add(row, headings, commands, goals) {
    this.rows.push(this.stored(row, headings));
    this.commands.push(commands);
    for (const team of goals) this.goals.push([this.first + this.rows.length - 1, team]);
    if (this.rows.length <= MOST_FRAMES) return;
    this.rows.shift();
    this.commands.shift();
    this.first += 1;
    this.goals = this.goals.filter(([frame]) => frame >= this.first);
  }

  /** Numbers in the order of the file, with an angle for cosine and sine. */
  stored(row, headings) {
    const { ball, robot } = this.names;
    const numbers = [...row.subarray(0, ball.length)];
    for (let i = 0; i < this.robots; i++) {
      const at = ball.length + i * robot.length;
      robot.forEach((name, column) => {
        if (name === "cos") numbers.push(headings[i]);
        else if (name !== "sin") numbers.push(row[at + column]);
      });
    }
    return numbers;
  }

  /** Bytes of the file. `about` has task, team names, configuration and versions. */
  async file(about) {
    const { ball, robot } = this.names;
    const stored = robot.filter((name) => name !== "sin").map((name) => (name === "cos" ? "heading" : name));
    const command = about.commandColumns;
    const step = (name) => this.steps[name];
    const robots = Array.from({ length: this.robots }, (_, i) => i);
    const rowSteps = [...ball.map(step), ...robots.flatMap(() => stored.map(step))];
    const commandSteps = robots.flatMap(() => command.map(step));
    const plain = {
      rows: encodeColumns(this.rows, rowSteps),
      commands: encodeColumns(this.commands, commandSteps),
    };
    const frames = this.rows.length;
    const packed = await Promise.all(Object.values(plain).map(deflate));
    const header = {
      package: about.package,
      physics: about.physics,
      task: about.task,
      options: null,
      controllers: about.controllers,
      names: about.names,
      config: about.config,
      columns: { ball, robot: stored, command, referee: [], sensed: [] },
      steps: { rows: rowSteps, commands: commandSteps, terms: {}, referee: [], sensed: [] },
      frames,
      observers: [],
      episodes: [{ start: 0, stop: frames, end: "", metrics: {} }],
      events: this.goals.map(([frame, team]) => [frame - this.first, "goal", "", team]),
      marker_sets: [[]],
      markers: [[0, 0]],
      snapshots: [],
      sections: Object.keys(plain).map((name, i) => [name, packed[i].length, plain[name].length]),
    };
    const head = await deflate(new TextEncoder().encode(JSON.stringify(header)));
    return joined(head, packed);
  }
}

/** The file: fixed part, checksum, header, sections. */
async function joined(head, sections) {
  const body = new Uint8Array(await new Blob([head, ...sections]).arrayBuffer());
  const fixed = new Uint8Array(24);
  fixed.set(FILE_MAGIC);
  const view = new DataView(fixed.buffer);
  view.setUint32(8, FILE_VERSION, true);
  view.setUint32(12, head.length, true);
  view.setBigUint64(16, BigInt(FILE_START + body.length), true);
  const checked = await new Blob([fixed, body]).arrayBuffer();
  const digest = new Uint8Array(await crypto.subtle.digest("SHA-256", checked));
  return new Uint8Array(await new Blob([fixed, digest, body]).arrayBuffer());
}
