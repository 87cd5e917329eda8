// Reader of replay files; the format is described in docs/replays.md.

const MAGIC = [0x89, 0x52, 0x53, 0x52, 0x0d, 0x0a, 0x1a, 0x0a];
const VERSION = 4;
const START = 56; // bytes before the header

/** Return the bytes of a text in base64. */
function bytesOf(base64) {
  return Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
}

/** Return decompressed bytes (zlib). */
async function inflate(bytes) {
  if (typeof DecompressionStream === "undefined") {
    throw new Error("this browser is too old: it has no DecompressionStream");
  }
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Return columns [column * frames + frame] from planes of zigzag differences. */
function decodeColumns(bytes, frames, steps) {
  const count = frames * steps.length;
  if (bytes.length !== 4 * count) {
    throw new Error(`a section has ${bytes.length} bytes, expected ${4 * count}`);
  }
  const values = new Float32Array(count);
  for (let column = 0; column < steps.length; column++) {
    let whole = 0;
    for (let frame = 0; frame < frames; frame++) {
      const i = column * frames + frame;
      const zigzag =
        bytes[i] | (bytes[count + i] << 8) | (bytes[2 * count + i] << 16) | (bytes[3 * count + i] << 24);
      whole = (whole + ((zigzag >>> 1) ^ -(zigzag & 1))) | 0;
      values[i] = whole * steps[column];
    }
  }
  return values;
}

/** A replay: header and columns, with access by frame. */
class Replay {
  constructor(header, rows, commands, terms, referee, sensed) {
    const { ball, robot, command } = header.columns;
    this.header = header;
    this.frames = header.frames;
    this.rows = rows;
    this.commands = commands;
    this.terms = terms; // by name, [observer * frames + frame]
    this.refereeNumbers = referee;
    this.refereeColumns = indexByName(header.columns.referee);
    this.sensedNumbers = sensed; // null if robots knew the true state
    this.sensedColumns = indexByName(header.columns.sensed);
    this.termNames = Object.keys(terms);
    this.ballColumns = indexByName(ball);
    this.robotColumns = indexByName(robot);
    this.commandColumns = command;
    this.robotCount = (header.steps.rows.length - ball.length) / robot.length;
    this.starts = new Uint8Array(this.frames);
    this.episodeOf = new Uint32Array(this.frames);
    header.episodes.forEach((episode, index) => {
      this.starts[episode.start] = 1;
      this.episodeOf.fill(index, episode.start, episode.stop);
    });
    this.goals = header.events
      .filter(([, kind]) => kind === "goal")
      .map(([frame, , , team]) => ({ frame, team }));
  }

  ball(name, frame) {
    return this.rows[this.ballColumns[name] * this.frames + frame];
  }

  robot(index, name, frame) {
    const ballSize = this.header.columns.ball.length;
    const size = this.header.columns.robot.length;
    return this.rows[(ballSize + index * size + this.robotColumns[name]) * this.frames + frame];
  }

  command(index, column, frame) {
    return this.commands[(index * this.commandColumns.length + column) * this.frames + frame];
  }

  term(name, observer, frame) {
    return this.terms[name][observer * this.frames + frame];
  }

  /** A number of the state of the referee, in matches that have one. */
  referee(name, frame) {
    return this.refereeNumbers[this.refereeColumns[name] * this.frames + frame];
  }

  /** A number of what the robots knew, in matches in which they had senses. */
  sensed(name, frame) {
    return this.sensedNumbers[this.sensedColumns[name] * this.frames + frame];
  }

  /** Seconds of play at a frame; initial states take no time. */
  clock(frame, timeStep) {
    return (frame - this.episodeOf[frame]) * timeStep;
  }

  score(frame) {
    const score = { blue: 0, yellow: 0 };
    for (const goal of this.goals) {
      if (goal.frame <= frame) score[goal.team] += 1;
    }
    return score;
  }
}

function indexByName(names) {
  return Object.fromEntries(names.map((name, index) => [name, index]));
}

/** Read a replay file. */
async function readReplay(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.length);
  if (bytes.length < START || MAGIC.some((byte, i) => bytes[i] !== byte)) {
    throw new Error("this is no replay file");
  }
  if (view.getUint32(8, true) !== VERSION) {
    throw new Error(`the replay has format ${view.getUint32(8, true)}, expected ${VERSION}`);
  }
  const headerSize = view.getUint32(12, true);
  const head = await inflate(bytes.subarray(START, START + headerSize));
  const header = JSON.parse(new TextDecoder().decode(head));
  const sections = {};
  let start = START + headerSize;
  for (const [name, packed] of header.sections) {
    sections[name] = await inflate(bytes.subarray(start, start + packed));
    start += packed;
  }
  const { frames, steps } = header;
  const optional = (name) =>
    steps[name].length ? decodeColumns(sections[name], frames, steps[name]) : null;
  const terms = {};
  for (const [name, step] of Object.entries(steps.terms)) {
    const termSteps = new Array(header.observers.length).fill(step);
    terms[name] = decodeColumns(sections[`term:${name}`], frames, termSteps);
  }
  return new Replay(
    header,
    decodeColumns(sections.rows, frames, steps.rows),
    decodeColumns(sections.commands, frames, steps.commands),
    terms,
    optional("referee"),
    optional("sensed")
  );
}
