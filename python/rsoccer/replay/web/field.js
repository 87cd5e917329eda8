// Drawing of the field, the robots and the ball on a canvas.
// World coordinates are meters, x toward yellow's goal and y to the left of it.

const TRAIL_SECONDS = 1.2;
const KICK_SECONDS = 0.3;
const MIN_ROBOT_PIXELS = 18; // smaller robots are drawn larger, up to MAX_ROBOT_GROWTH
const MAX_ROBOT_GROWTH = 1.8;
const MIN_BALL_PIXELS = 4; // smallest drawn radius
const STROKE = 2; // width of markers, in widths of the field's lines
const ZOOMS = [1, 2, 4];

/** Position of a body between frames `i` and `i + 1`, at the share `t`. */
function between(a, b, t) {
  return a + (b - a) * t;
}

/** State of all bodies at a time between two frames. */
class Moment {
  constructor(replay, scene, time) {
    const last = replay.frames - 1;
    this.frame = Math.min(Math.floor(time), last);
    const next = Math.min(this.frame + 1, last);
    const share = replay.starts[next] ? 0 : time - this.frame;
    this.ball = this.bodyOfBall(replay, scene, next, share);
    this.robots = [];
    for (let i = 0; i < replay.robotCount; i++) {
      const absent = [this.frame, next].map((frame) => replay.robot(i, "absent", frame) > 0);
      // A robot that leaves or enters jumps.
      const t = absent[0] === absent[1] ? share : 0;
      const value = (name) => between(replay.robot(i, name, this.frame), replay.robot(i, name, next), t);
      this.robots.push({
        x: value("x"),
        y: value("y"),
        heading: value("heading"),
        hasBall: replay.robot(i, "infrared", this.frame) > 0,
        absent: absent[0],
      });
    }
    this.sensed = replay.sensedNumbers && sensedBodies(replay, this.frame, next, share);
  }

  bodyOfBall(replay, scene, next, share) {
    const at = (name, frame) => replay.ball(name, frame);
    const moved = Math.hypot(at("x", next) - at("x", this.frame), at("y", next) - at("y", this.frame));
    const speeds = [this.frame, next].map((frame) => Math.hypot(at("v_x", frame), at("v_y", frame)));
    // A ball that is put elsewhere jumps.
    const jumps = moved > 0.05 + 3 * scene.timeStep * Math.max(...speeds);
    const t = jumps ? 0 : share;
    const value = (name) => between(at(name, this.frame), at(name, next), t);
    return { x: value("x"), y: value("y"), z: Math.max(0, value("z")) };
  }
}

/** View of the world: scale, center and orientation. */
class Camera {
  constructor(scene) {
    this.scene = scene;
    const [left, bottom, right, top] = scene.bounds;
    this.width = right - left;
    this.height = top - bottom;
    this.zoom = 1;
    this.x = 0;
    this.y = 0;
    this.upright = false; // x points up, for screens that are higher than wide
    this.resize(640, 480);
  }

  resize(width, height) {
    this.pixelWidth = width;
    this.pixelHeight = height;
    const [across, along] = this.upright ? [this.height, this.width] : [this.width, this.height];
    this.fit = Math.min(width / across, height / along);
  }

  get scale() {
    return this.fit * this.zoom;
  }

  /** Keep the view within the arena. */
  center(x, y) {
    const [width, height] = this.upright
      ? [this.pixelHeight, this.pixelWidth]
      : [this.pixelWidth, this.pixelHeight];
    const limitX = Math.max(0, (this.width - width / this.scale) / 2);
    const limitY = Math.max(0, (this.height - height / this.scale) / 2);
    this.x = Math.min(Math.max(x, -limitX), limitX);
    this.y = Math.min(Math.max(y, -limitY), limitY);
  }

  /** Coefficients for `setTransform`, from meters to pixels. */
  get matrix() {
    const s = this.scale;
    const [cx, cy] = [this.pixelWidth / 2, this.pixelHeight / 2];
    return this.upright
      ? [0, -s, -s, 0, cx + this.y * s, cy + this.x * s]
      : [s, 0, 0, -s, cx - this.x * s, cy + this.y * s];
  }

  toScreen(x, y) {
    const [a, b, c, d, e, f] = this.matrix;
    return [a * x + c * y + e, b * x + d * y + f];
  }

  toWorld(px, py) {
    const [a, b, c, d, e, f] = this.matrix;
    return this.upright ? [(py - f) / b, (px - e) / c] : [(px - e) / a, (py - f) / d];
  }

  /** Angle on the screen, clockwise, of a heading in the world. */
  angle(heading) {
    return -heading - (this.upright ? Math.PI / 2 : 0);
  }
}

/** Draws moments of a replay. */
class FieldView {
  constructor(canvas, replay, scene) {
    this.canvas = canvas;
    this.context = canvas.getContext("2d");
    this.replay = replay;
    this.scene = scene;
    this.camera = new Camera(scene);
    this.trails = true;
    this.ghosts = true; // ball and robots where the robots believe them
    this.selected = -1;
    this.hovered = -1;
    this.floor = null; // marks of a referee
    this.background = null;
    this.sprites = new Map();
    this.kicks = replay.header.events.filter(([, kind]) => kind === "kick");
  }

  /** Fit the canvas into a width and a height, CSS pixels. */
  resize(width, maxHeight) {
    const { camera, canvas } = this;
    camera.upright = width < 560 && maxHeight > width;
    const ratio = camera.upright ? camera.width / camera.height : camera.height / camera.width;
    const height = Math.round(Math.min(width * ratio, maxHeight));
    const density = Math.min(window.devicePixelRatio || 1, 2);
    canvas.width = Math.round(width * density);
    canvas.height = Math.round(height * density);
    canvas.style.height = `${height}px`;
    this.density = density;
    camera.resize(canvas.width, canvas.height);
    this.forget();
  }

  /** Drop pictures that depend on the scale. */
  forget() {
    this.background = null;
    this.sprites.clear();
  }

  get zoomed() {
    return this.camera.zoom > 1;
  }

  nextZoom() {
    const index = ZOOMS.indexOf(this.camera.zoom);
    this.camera.zoom = ZOOMS[(index + 1) % ZOOMS.length];
    this.forget();
  }

  /** Factor on the drawn size of a robot. */
  growth(outlines) {
    const wanted = (MIN_ROBOT_PIXELS * this.density) / (outlines.size * this.camera.scale);
    return Math.min(Math.max(wanted, 1), MAX_ROBOT_GROWTH);
  }

  draw(time) {
    const { context, camera, replay, scene } = this;
    const moment = new Moment(replay, scene, time);
    camera.center(this.zoomed ? moment.ball.x : 0, this.zoomed ? moment.ball.y : 0);
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, camera.pixelWidth, camera.pixelHeight);
    this.drawBackground();
    context.setTransform(...camera.matrix);
    this.floor?.draw(this, moment);
    this.drawMarkers(moment.frame);
    if (this.trails) this.drawTrails(time, moment);
    this.drawBallOnFloor(moment.ball);
    this.drawKicks(time, moment);
    if (this.ghosts && moment.sensed) drawGhosts(this, moment);
    moment.robots.forEach((robot, index) => {
      if (!robot.absent) this.drawRobot(robot, index);
    });
    this.drawBall(moment.ball);
    return moment;
  }

  drawBackground() {
    const { context, camera } = this;
    if (this.zoomed) {
      context.setTransform(...camera.matrix);
      this.scene.field.forEach((shape) => drawShape(context, shape, false));
      return;
    }
    if (!this.background) {
      this.background = document.createElement("canvas");
      this.background.width = camera.pixelWidth;
      this.background.height = camera.pixelHeight;
      const offscreen = this.background.getContext("2d");
      offscreen.setTransform(...camera.matrix);
      this.scene.field.forEach((shape) => drawShape(offscreen, shape, true, camera.scale));
    }
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.drawImage(this.background, 0, 0);
  }

  drawMarkers(frame) {
    const { marker_sets: sets, markers } = this.replay.header;
    let set = [];
    for (const [start, index] of markers) {
      if (start <= frame) set = sets[index];
    }
    for (const marker of set) drawMarker(this.context, this.scene, marker);
  }

  drawTrails(time, moment) {
    const { context, replay, scene } = this;
    const first = this.firstOfTrail(time);
    const width = Math.max(1.6 * this.density / this.camera.scale, 0.004);
    context.lineCap = "butt"; // round ends of transparent pieces would show as beads
    moment.robots.forEach((robot, index) => {
      if (robot.absent) return;
      const color = index < scene.nBlue ? scene.colors.blue : scene.colors.yellow;
      const at = (frame) => [replay.robot(index, "x", frame), replay.robot(index, "y", frame)];
      this.drawTrail(at, first, moment.frame, robot, color, width * 1.5, 0.45);
    });
    const at = (frame) => [replay.ball("x", frame), replay.ball("y", frame)];
    this.drawTrail(at, first, moment.frame, moment.ball, scene.colors.orange, width * 2, 0.8);
  }

  /** First frame of the trails at a time: in the same episode. */
  firstOfTrail(time) {
    const { replay, scene } = this;
    const frame = Math.floor(time);
    const episode = replay.header.episodes[replay.episodeOf[Math.min(frame, replay.frames - 1)]];
    return Math.max(episode.start, Math.ceil(time - TRAIL_SECONDS / scene.timeStep));
  }

  /** A line that fades out backwards, in a few pieces of equal opacity. */
  drawTrail(at, first, last, body, color, width, opacity) {
    const { context } = this;
    const pieces = 6;
    context.strokeStyle = color;
    context.lineWidth = width;
    for (let piece = 0; piece < pieces; piece++) {
      const start = first + Math.floor(((last - first) * piece) / pieces);
      const stop = first + Math.floor(((last - first) * (piece + 1)) / pieces);
      context.globalAlpha = (opacity * (piece + 1)) / pieces;
      context.beginPath();
      let [lastX, lastY] = at(start);
      context.moveTo(lastX, lastY);
      for (let frame = start + 1; frame <= stop; frame++) {
        const [x, y] = at(frame);
        const jumps = Math.hypot(x - lastX, y - lastY) > 0.4;
        if (jumps) context.moveTo(x, y);
        else context.lineTo(x, y);
        [lastX, lastY] = [x, y];
      }
      if (piece === pieces - 1) context.lineTo(body.x, body.y);
      context.stroke();
    }
    context.globalAlpha = 1;
  }

  ballRadius(ball) {
    const { radius, growth, maxGrowth } = this.scene.ball;
    const smallest = (MIN_BALL_PIXELS * this.density) / this.camera.scale;
    return Math.max(radius, smallest) * Math.min(1 + growth * ball.z, maxGrowth);
  }

  /** Halo, and the shadow of a ball in flight with a line up to the ball. */
  drawBallOnFloor(ball) {
    const { context, scene } = this;
    const radius = this.ballRadius(ball);
    fillCircle(context, ball.x, ball.y, 2.3 * radius, scene.colors.halo, 0.55);
    const offset = scene.ball.shadowOffset * ball.z;
    const [x, y] = [ball.x + offset, ball.y - offset];
    fillCircle(context, x, y, 1.2 * radius, scene.colors.shadow, ball.z > 0.005 ? 1 : 0.8);
    if (ball.z > 0.005) {
      context.strokeStyle = scene.colors.shadow;
      context.lineWidth = 0.4 * radius;
      strokeLine(context, x, y, ball.x, ball.y);
    }
  }

  drawBall(ball) {
    const { context, scene } = this;
    const radius = this.ballRadius(ball);
    context.setTransform(...this.camera.matrix);
    fillCircle(context, ball.x, ball.y, radius, scene.colors.orange);
    context.strokeStyle = "rgba(90, 32, 0, 0.75)";
    context.lineWidth = 0.16 * radius;
    context.beginPath();
    context.arc(ball.x, ball.y, radius, 0, 2 * Math.PI);
    context.stroke();
    const [side, up] = this.camera.upright ? [0.35, 0.3] : [-0.3, 0.35];
    fillCircle(context, ball.x + side * radius, ball.y + up * radius, 0.3 * radius, scene.colors.highlight);
  }

  /** Rings around the robots that kicked a moment ago. */
  drawKicks(time, moment) {
    const { context, replay, scene } = this;
    for (const [frame, , name] of this.kicks) {
      const age = ((time - frame) * scene.timeStep) / KICK_SECONDS;
      const index = this.indexOf(name);
      if (age < 0 || age > 1 || replay.episodeOf[frame] !== replay.episodeOf[moment.frame]) continue;
      const x = replay.robot(index, "x", frame);
      const y = replay.robot(index, "y", frame);
      const size = this.sizeOf(index);
      context.strokeStyle = scene.colors.white;
      context.globalAlpha = 0.9 * (1 - age);
      context.lineWidth = 0.12 * size;
      context.beginPath();
      context.arc(x, y, size * (0.6 + 0.9 * age), 0, 2 * Math.PI);
      context.stroke();
      context.globalAlpha = 1;
    }
  }

  indexOf(name) {
    const [team, number] = name.split("_");
    return Number(number) + (team === "yellow" ? this.scene.nBlue : 0);
  }

  outlinesOf(index) {
    return this.scene.outlines[this.scene.robots[index]];
  }

  sizeOf(index) {
    const outlines = this.outlinesOf(index);
    return outlines.size * this.growth(outlines);
  }

  drawRobot(robot, index) {
    const { context, camera, scene } = this;
    const outlines = this.outlinesOf(index);
    const team = index < scene.nBlue ? "blue" : "yellow";
    const [x, y] = camera.toScreen(robot.x, robot.y);
    const sprite = this.sprite(team, scene.robots[index], robot.hasBall);
    const angle = camera.angle(robot.heading);
    context.setTransform(Math.cos(angle), Math.sin(angle), -Math.sin(angle), Math.cos(angle), x, y);
    context.drawImage(sprite, -sprite.width / 2, -sprite.height / 2);
    this.drawNumber(robot, index, outlines, team);
    if (index === this.selected || index === this.hovered) this.drawRing(x, y, index);
  }

  drawNumber(robot, index, outlines, team) {
    const { context, camera, scene } = this;
    const growth = this.growth(outlines);
    const number = String(team === "blue" ? index : index - scene.nBlue);
    const offset = outlines.numberX * growth;
    const [x, y] = camera.toScreen(
      robot.x + offset * Math.cos(robot.heading),
      robot.y + offset * Math.sin(robot.heading)
    );
    // Capitals are 0.7 of the font's size high. Two digits are narrower.
    const height = (outlines.numberHeight * growth * camera.scale) / 0.7;
    const size = Math.max(height, 9 * this.density) * (number.length > 1 ? 0.82 : 1);
    context.setTransform(1, 0, 0, 1, x, y);
    context.font = `700 ${size}px system-ui, sans-serif`;
    context.textAlign = "center";
    context.textBaseline = "middle";
    context.fillStyle = team === "blue" ? scene.colors.white : scene.colors.ink;
    context.fillText(number, 0, 0.04 * size);
  }

  drawRing(x, y, index) {
    const { context } = this;
    context.setTransform(1, 0, 0, 1, x, y);
    context.strokeStyle = this.scene.colors.white;
    context.lineWidth = (index === this.selected ? 1.8 : 1.2) * this.density;
    context.beginPath();
    context.arc(0, 0, 0.8 * this.sizeOf(index) * this.camera.scale, 0, 2 * Math.PI);
    context.stroke();
  }

  /** Picture of a robot that faces to the right. */
  sprite(team, model, hasBall) {
    const key = `${team} ${model} ${hasBall}`;
    if (!this.sprites.has(key)) {
      this.sprites.set(key, this.newSprite(team, this.scene.outlines[model], hasBall));
    }
    return this.sprites.get(key);
  }

  newSprite(team, outlines, hasBall) {
    const { colors } = this.scene;
    const scale = this.growth(outlines) * this.camera.scale;
    const canvas = document.createElement("canvas");
    canvas.width = canvas.height = 2 * Math.ceil(0.95 * outlines.size * scale);
    const context = canvas.getContext("2d");
    const fill = (points, color) => {
      context.fillStyle = color;
      tracePolygon(context, points);
      context.fill();
    };
    context.setTransform(scale, 0, 0, -scale, canvas.width / 2, canvas.height / 2);
    context.shadowColor = "rgba(0, 0, 0, 0.55)";
    context.shadowBlur = 0.16 * outlines.size * scale;
    fill(outlines.hull, outlines.hullColors[team]);
    context.shadowColor = "transparent";
    outlines.wheels.forEach((wheel) => fill(wheel, colors.tire));
    fill(outlines.cover, colors[team]);
    if (outlines.arrow.length) fill(outlines.arrow, team === "blue" ? colors.white : colors.ink);
    if (outlines.dribbler.length) {
      if (hasBall) {
        context.shadowColor = colors["dribbler-lit"];
        context.shadowBlur = 0.25 * outlines.size * scale;
      }
      fill(outlines.dribbler, hasBall ? colors["dribbler-lit"] : colors.dribbler);
    }
    return canvas;
  }

  /** Index of the robot at a place on the canvas (CSS pixels), or -1. */
  robotAt(px, py, time) {
    const moment = new Moment(this.replay, this.scene, time);
    const [x, y] = this.camera.toWorld(px * this.density, py * this.density);
    const reach = (12 * this.density) / this.camera.scale;
    let best = -1;
    let least = Infinity;
    moment.robots.forEach((robot, index) => {
      const distance = Math.hypot(robot.x - x, robot.y - y);
      if (!robot.absent && distance < least && distance < Math.max(0.7 * this.sizeOf(index), reach)) {
        [best, least] = [index, distance];
      }
    });
    return best;
  }
}

/** Draw a shape of the field. Soft shadows are drawn on request, with their width in pixels. */
function drawShape(context, [kind, color, ...numbers], soft, scale = 1) {
  if (kind === "polygon") {
    const [blur, points] = numbers;
    if (blur && !soft) return;
    context.save();
    if (blur) {
      context.shadowColor = color;
      context.shadowBlur = blur * scale;
    }
    context.fillStyle = color;
    tracePolygon(context, points);
    context.fill();
    context.restore();
  } else if (kind === "circle") {
    const [x, y, radius] = numbers;
    fillCircle(context, x, y, radius, color);
  } else if (kind === "line") {
    const [x0, y0, x1, y1, width] = numbers;
    context.lineCap = "square";
    context.lineWidth = width;
    context.strokeStyle = color;
    strokeLine(context, x0, y0, x1, y1);
  } else {
    const [x, y, radius, start, end, width] = numbers;
    context.lineCap = "butt";
    context.lineWidth = width;
    context.strokeStyle = color;
    context.beginPath();
    context.arc(x, y, radius, start, end);
    context.stroke();
  }
}

/** Draw a target, gate, area or segment. */
function drawMarker(context, scene, [kind, ...values]) {
  const width = STROKE * scene.lineWidth;
  const done = kind === "Gate" && values[2];
  const color = done ? scene.colors.done : scene.colors.pending;
  context.strokeStyle = color;
  context.lineWidth = width;
  context.lineCap = "round";
  if (kind === "Target") {
    const [[x, y], radius] = values;
    fillCircle(context, x, y, radius, color, 0.2);
    context.beginPath();
    context.arc(x, y, radius, 0, 2 * Math.PI);
    context.stroke();
    fillCircle(context, x, y, width, color);
  } else if (kind === "Gate") {
    drawGate(context, scene, values, color);
  } else if (kind === "Area") {
    const [[x0, y0], [x1, y1]] = values;
    context.globalAlpha = 0.2;
    context.fillStyle = color;
    context.fillRect(x0, y0, x1 - x0, y1 - y0);
    context.globalAlpha = 0.6;
    context.strokeRect(x0, y0, x1 - x0, y1 - y0);
    context.globalAlpha = 1;
  } else {
    const [start, end] = values;
    strokeLine(context, ...start, ...end);
    for (const [x, y] of values) fillCircle(context, x, y, 1.5 * width, color);
  }
}

/** Draw the posts of a gate, the line between them and an arrow through it. */
function drawGate(context, scene, [left, right], color) {
  const unit = scene.lineWidth;
  const width = Math.hypot(left[0] - right[0], left[1] - right[1]) || 1;
  context.globalAlpha = 0.6;
  strokeLine(context, ...left, ...right);
  context.globalAlpha = 1;
  // The way leads a quarter turn clockwise from the line between right and left post.
  const [dx, dy] = [(left[1] - right[1]) / width, (right[0] - left[0]) / width];
  const [x, y] = [(left[0] + right[0]) / 2, (left[1] + right[1]) / 2];
  const at = (ahead, aside) => [x + ahead * dx - aside * dy, y + ahead * dy + aside * dx];
  const length = 14 * unit;
  strokeLine(context, ...at(-0.6 * length, 0), ...at(0.4 * length, 0));
  context.fillStyle = color;
  tracePolygon(context, [
    ...at(length, 0),
    ...at(0.4 * length, 0.45 * length),
    ...at(0.4 * length, -0.45 * length),
  ]);
  context.fill();
  for (const [px, py] of [left, right]) fillCircle(context, px, py, 3.6 * unit, color);
}

function tracePolygon(context, points) {
  context.beginPath();
  for (let i = 0; i < points.length; i += 2) {
    if (i) context.lineTo(points[i], points[i + 1]);
    else context.moveTo(points[i], points[i + 1]);
  }
  context.closePath();
}

function fillCircle(context, x, y, radius, color, opacity = 1) {
  context.globalAlpha = opacity;
  context.fillStyle = color;
  context.beginPath();
  context.arc(x, y, radius, 0, 2 * Math.PI);
  context.fill();
  context.globalAlpha = 1;
}

function strokeLine(context, x0, y0, x1, y1) {
  context.beginPath();
  context.moveTo(x0, y0);
  context.lineTo(x1, y1);
  context.stroke();
}
