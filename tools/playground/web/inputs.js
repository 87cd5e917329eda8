// Keyboard, gamepad and touch as controls of one robot; keys as in `rsoccer play`.

const MOVES = {
  w: [0, 1, 0], arrowup: [0, 1, 0],
  s: [0, -1, 0], arrowdown: [0, -1, 0],
  a: [-1, 0, 0], arrowleft: [-1, 0, 0],
  d: [1, 0, 0], arrowright: [1, 0, 0],
  q: [0, 0, 1], e: [0, 0, -1],
};
const PASS_KICK = 0.5; // of the fastest kick
const DEAD_ZONE = 0.15; // deflection of a stick that counts as none
const TURN_GAIN = 2; // turn for each radian between heading and stick

class Inputs {
  constructor() {
    this.held = new Set();
    this.tapped = new Set(); // pressed since the last reading
    this.stick = null; // deflection of the stick on the screen, field coordinates
    this.buttons = { kick: false, chip: false };
    this.dribbles = true;
  }

  /** True if the key is one of the robot's. */
  press(key) {
    const name = key.toLowerCase();
    const known = name in MOVES || [" ", "c", "shift", "v", "x"].includes(name);
    if (!known) return false;
    if (name === "v") this.dribbles = !this.dribbles;
    this.held.add(name);
    this.tapped.add(name);
    return true;
  }

  release(key) {
    this.held.delete(key.toLowerCase());
  }

  releaseAll() {
    this.held.clear();
    this.tapped.clear();
    this.stick = null;
    this.buttons = { kick: false, chip: false };
  }

  /** Whether a person moves or kicks. */
  get active() {
    const moving = Object.keys(MOVES).some((key) => this.held.has(key));
    return moving || this.stick !== null || this.buttons.kick || this.buttons.chip || this.pad !== null;
  }

  /** The gamepad in use, if a stick or button of it is. */
  get pad() {
    for (const pad of navigator.getGamepads?.() ?? []) {
      if (!pad) continue;
      const moved = pad.axes.some((axis) => Math.abs(axis) > DEAD_ZONE);
      if (moved || pad.buttons.some((button) => button.pressed)) return pad;
    }
    return null;
  }

  /** Controls of a robot with a heading; `wheels` for a differential drive. */
  controls(heading, wheels) {
    const is = (key) => this.held.has(key) || this.tapped.has(key);
    let [right, up, turn] = [0, 0, 0];
    for (const [key, move] of Object.entries(MOVES)) {
      if (!is(key)) continue;
      right += move[0];
      up += move[1];
      turn += move[2];
    }
    const { pad } = this;
    const pressed = (index) => pad?.buttons[index]?.pressed ?? false;
    let direction = this.stick;
    if (pad) {
      const axis = (index) => (Math.abs(pad.axes[index] ?? 0) > DEAD_ZONE ? pad.axes[index] : 0);
      direction ??= { x: axis(0), y: -axis(1) };
      turn -= axis(2);
    }
    if (direction && (direction.x || direction.y)) {
      const toward = driveToward(direction, heading, wheels);
      right += toward.right;
      up += toward.up;
      if (!turn) turn += toward.turn;
    }
    const limit = (value) => Math.max(-1, Math.min(1, value));
    const chip = is("c") || this.buttons.chip || pressed(1);
    const full = is(" ") || this.buttons.kick || pressed(0);
    const pass = is("x") || pressed(2);
    this.tapped.clear();
    return {
      right: limit(right),
      up: limit(up),
      turn: limit(turn),
      kick: full || chip ? 1 : pass ? PASS_KICK : 0,
      chip,
      dribble: this.dribbles,
      slow: is("shift") || pressed(4),
    };
  }
}

/** Controls that move a robot into a direction of the field, front or, for wheels, back ahead. */
function driveToward({ x, y }, heading, wheels) {
  const error = Math.atan2(y, x) - heading;
  const size = Math.min(1, Math.hypot(x, y));
  if (!wheels) {
    const turn = Math.atan2(Math.sin(error), Math.cos(error)) * TURN_GAIN;
    return { right: x, up: y, turn: Math.max(-1, Math.min(1, turn)) };
  }
  const sign = Math.cos(error) < 0 ? -1 : 1;
  return { right: 0, up: size * Math.cos(error), turn: sign * size * Math.sin(error) * TURN_GAIN };
}
