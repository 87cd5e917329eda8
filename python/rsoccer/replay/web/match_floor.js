// Marks of a referee on the floor: areas, the place of the next kick, distances to keep.

const POSITION_PIXELS = 11; // radius of the mark of the next kick
const MARK_PIXELS = 1.5; // width of strokes
const TOUCH_RADIUS = 0.78; // of the disc under a robot that may touch the ball, in sizes of it

class MatchFloor {
  constructor(replay, scene, match) {
    this.replay = replay;
    this.scene = scene;
    this.match = match;
    this.ballDistance = replay.referee("ball_distance", 0);
  }

  color(team, opacity) {
    return `rgba(${this.match.markColors[team].join(",")},${opacity})`;
  }

  /** Draw under robots and ball; coordinates are meters. */
  draw(view, moment) {
    const { context } = view;
    const { opacity } = this.match;
    context.lineCap = "butt";
    this.match.areas.forEach((area, index) => {
      context.globalAlpha = opacity.area;
      context.fillStyle = this.scene.colors[index ? "yellow" : "blue"];
      tracePolygon(context, area);
      context.fill();
      context.globalAlpha = 1;
    });
    const { frame, ball } = moment;
    const place = ["x", "y"].map((axis) => this.replay.referee(`designated_position_${axis}`, frame));
    const [, keptOff, team, kick] = valueAt(this.match.marks, frame);
    context.lineWidth = (MARK_PIXELS * view.density) / view.camera.scale;
    if (keptOff) this.drawKeptOff(context, ball, keptOff === "disc" ? null : place, team);
    if (kick !== null) this.drawPosition(view, place, kick);
    this.drawWhoMayTouch(view, moment);
  }

  /** A disc around the ball, or all points near the line from it to its place. */
  drawKeptOff(context, ball, place, team) {
    const { fill, edge } = this.match.opacity;
    const [x, y] = place ?? [ball.x, ball.y];
    const angle = Math.atan2(y - ball.y, x - ball.x);
    context.beginPath();
    context.arc(ball.x, ball.y, this.ballDistance, angle + Math.PI / 2, angle + 1.5 * Math.PI);
    context.arc(x, y, this.ballDistance, angle - Math.PI / 2, angle + Math.PI / 2);
    context.closePath();
    context.fillStyle = this.color(team, fill);
    context.fill();
    context.strokeStyle = this.color(team, edge);
    context.stroke();
    if (place) strokeLine(context, ball.x, ball.y, x, y);
  }

  /** A ring with four ticks. */
  drawPosition(view, [x, y], team) {
    const { context } = view;
    const radius = (POSITION_PIXELS * view.density) / view.camera.scale;
    context.strokeStyle = this.color(team, 1);
    context.beginPath();
    context.arc(x, y, radius, 0, 2 * Math.PI);
    context.stroke();
    for (const [dx, dy] of [[1, 0], [0, 1], [-1, 0], [0, -1]]) {
      strokeLine(context, x + dx * radius, y + dy * radius, x + 1.6 * dx * radius, y + 1.6 * dy * radius);
    }
  }

  /** Discs under robots that may take a kick; a ring around one that may not touch the ball again. */
  drawWhoMayTouch(view, { frame, robots }) {
    const { context } = view;
    const inPlay = this.replay.referee("in_play", frame) > 0;
    robots.forEach((robot, index) => {
      const mayTouch = this.replay.referee(`may_touch_${index}`, frame) > 0;
      if (robot.absent || mayTouch === inPlay) return;
      const radius = TOUCH_RADIUS * view.sizeOf(index);
      if (mayTouch) {
        fillCircle(context, robot.x, robot.y, radius, this.scene.colors.white, this.match.opacity.mayTouch);
        return;
      }
      context.strokeStyle = this.scene.colors["red-card"];
      context.beginPath();
      context.arc(robot.x, robot.y, radius, 0, 2 * Math.PI);
      context.stroke();
    });
  }
}
