// Keyboard, gamepad and touch as controls of one robot; keys are those of `rsoccer play`.

const DEAD_ZONE = 0.15; // deflection of a stick that counts as none
const TURN_GAIN = 2; // turn for each radian between heading and stick

class Inputs {
  /** `keys` has keys of movements, kicker, dribbler and slow, and the speed of a pass. */
  constructor(keys) {
    this.keys = keys;
    this.held = new Set();
    this.tapped = new Set(); // pressed since the last reading
    this.stick = null; // deflection of the stick on the screen, field coordinates
    this.buttons = { kick: false, chip: false };
    this.dribbles = false;
  }

  /** True if the key, in lower case, is one of the robot's. */
  has(name) {
    const { moves, kick, pass, chip, dribble, slow } = this.keys;
    return Object.hasOwn(moves, name) || [kick, pass, chip, dribble, ...slow].includes(name);
  }

  /** Note that a key of the robot went down. */
  press(name) {
    if (name === this.keys.dribble) this.dribbles = !this.dribbles;
    this.held.add(name);
    this.tapped.add(name);
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
    const moving = Object.keys(this.keys.moves).some((key) => this.held.has(key));
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
    for (const [key, move] of Object.entries(this.keys.moves)) {
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
    const chip = is(this.keys.chip) || this.buttons.chip || pressed(1);
    const full = is(this.keys.kick) || this.buttons.kick || pressed(0);
    const pass = is(this.keys.pass) || pressed(2);
    this.tapped.clear();
    return {
      right: limit(right),
      up: limit(up),
      turn: limit(turn),
      kick: full || chip ? 1 : pass ? this.keys.passKick : 0,
      chip,
      // The touch screen has no switch of the dribbler.
      dribble: this.dribbles || this.stick !== null || pressed(6),
      slow: this.keys.slow.some(is) || pressed(4),
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
