// The last seconds of a match in the form in which the player reads replays.

const FRAMES = 60; // as many as trails show, and some more

class LiveRows {
  constructor(names, robots, referee) {
    this.frames = FRAMES;
    this.robotCount = robots;
    this.ballNames = Object.fromEntries(names.ball.map((name, index) => [name, index]));
    this.robotNames = Object.fromEntries(names.robot.map((name, index) => [name, index]));
    this.ballSize = names.ball.length;
    this.robotSize = names.robot.length;
    this.rows = []; // the oldest first
    this.headings = [];
    this.sensedRows = [];
    this.sensedHeadings = [];
    this.sensedNumbers = null;
    this.state = referee;
    this.starts = new Uint8Array(FRAMES);
    this.episodeOf = new Uint32Array(FRAMES);
    this.header = { events: [], marker_sets: [[]], markers: [[0, 0]], episodes: [{ start: 0 }] };
  }

  /** Forget all, and begin with a row. */
  begin(row, sensed, report) {
    this.rows = [];
    this.headings = [];
    this.sensedRows = [];
    this.sensedHeadings = [];
    while (this.rows.length < FRAMES) this.add(row, sensed, report);
  }

  /** Add the newest row; `sensed` is null where robots know the true state. */
  add(row, sensed, report) {
    this.rows.push(row);
    this.headings.push(this.angles(row, this.headings));
    this.sensedRows.push(sensed ?? row);
    this.sensedHeadings.push(this.angles(sensed ?? row, this.sensedHeadings));
    this.sensedNumbers = sensed;
    this.state = report;
    if (this.rows.length > FRAMES) {
      this.rows.shift();
      this.headings.shift();
      this.sensedRows.shift();
      this.sensedHeadings.shift();
    }
  }

  /** Headings of a row, each the nearest to that before: they are drawn between frames. */
  angles(row, before) {
    const last = before[before.length - 1];
    return Array.from({ length: this.robotCount }, (_, i) => {
      const at = this.ballSize + i * this.robotSize;
      const angle = Math.atan2(row[at + this.robotNames.sin], row[at + this.robotNames.cos]);
      if (!last) return angle;
      return last[i] + Math.atan2(Math.sin(angle - last[i]), Math.cos(angle - last[i]));
    });
  }

  get newest() {
    return this.rows[this.rows.length - 1];
  }

  ball(name, frame) {
    return this.rows[frame][this.ballNames[name]];
  }

  robot(index, name, frame) {
    if (name === "heading") return this.headings[frame][index];
    return this.rows[frame][this.ballSize + index * this.robotSize + this.robotNames[name]];
  }

  /** Numbers by the names of replays: ball_x, x_0, heading_0 and so on. */
  sensed(name, frame) {
    const row = this.sensedRows[frame];
    const [, column, index] = /^(ball_.|x|y|heading)(?:_(\d+))?$/.exec(name);
    if (column.startsWith("ball")) return row[this.ballNames[column.slice(5)]];
    if (column === "heading") return this.sensedHeadings[frame][Number(index)];
    return row[this.ballSize + Number(index) * this.robotSize + this.robotNames[column]];
  }

  /** Numbers of the referee that the marks on the floor need. */
  referee(name) {
    if (name === "in_play") return this.state.in_play ? 1 : 0;
    if (name === "ball_distance") return 0.5; // SSL rules, "Referee Commands"
    if (name.startsWith("may_touch_")) return this.state.may_touch[Number(name.slice(10))] ? 1 : 0;
    return this.state.place[name.endsWith("_x") ? 0 : 1];
  }
}
