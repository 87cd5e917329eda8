// The live page: the last seconds of a match as a short replay whose frames move up.

const RETRY = 1000; // milliseconds until the page asks for the match again
const FULL = 1013; // code with which a server closes whose page too many watch

const $ = (id) => document.getElementById(id);

/** Shows frames as they come. */
class Live {
  constructor(replay, scene) {
    this.replay = replay;
    this.view = new FieldView($("field"), replay, scene);
    this.received = 0; // number of frames, for tests
    this.stale = false;
    $("name-blue").textContent = replay.header.names[0];
    $("name-yellow").textContent = replay.header.names[1];
    window.addEventListener("resize", () => this.resize());
    this.resize();
    this.draw = this.draw.bind(this);
    requestAnimationFrame(this.draw);
  }

  resize() {
    const width = $("field").parentElement.clientWidth;
    this.view.resize(width, Math.max(window.innerHeight - 180, 240));
    this.stale = true;
  }

  draw() {
    if (this.stale) this.view.draw(this.replay.frames - 1);
    this.stale = false;
    requestAnimationFrame(this.draw);
  }

  /** Add a frame: the oldest one leaves. */
  add(frame) {
    push(this.replay.rows, frame.row, this.replay.frames);
    push(this.replay.sensedNumbers, frame.sensed, this.replay.frames);
    $("goals-blue").textContent = frame.score[0];
    $("goals-yellow").textContent = frame.score[1];
    $("clock").textContent = frame.clock;
    $("stage").textContent = frame.stage;
    $("command").textContent = frame.command;
    $("drivers").textContent = frame.drivers;
    $("simulated").textContent = `${frame.seconds.toFixed(1)} s simulated`;
    $("message").hidden = true;
    this.received += 1;
    this.stale = true;
  }
}

/** Move all columns [column * frames + frame] up by one frame, and put new numbers at the end. */
function push(columns, numbers, frames) {
  if (!columns) return;
  columns.copyWithin(0, 1);
  numbers.forEach((number, column) => {
    columns[(column + 1) * frames - 1] = number;
  });
}

/** Watch; a server that comes back may serve another match, whose page is loaded anew. */
function connect(live, isGone = false) {
  const socket = new WebSocket(`ws://${window.location.host}/frames`);
  socket.onopen = () => {
    if (isGone) window.location.reload();
  };
  socket.onmessage = (event) => live.add(JSON.parse(event.data));
  socket.onclose = (event) => {
    $("message").textContent = event.reason || "The server is gone";
    $("message").hidden = false;
    setTimeout(() => connect(live, isGone || event.code !== FULL), RETRY);
  };
}

async function start() {
  const replay = await readReplay(bytesOf($("replay").textContent.trim()));
  const live = new Live(replay, JSON.parse($("scene").textContent));
  connect(live);
  return live;
}

// Tests reach the page by this name.
window.rsoccerLive = start();
window.rsoccerLive.catch((error) => {
  $("message").textContent = `The match cannot be shown: ${error.message}.`;
});
