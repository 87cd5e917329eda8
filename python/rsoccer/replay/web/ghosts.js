// Ghosts: ball and robots where the robots believe them, as thin outlines under the true ones.

const GHOST_PIXELS = 1.5; // width of outlines
const SENSED_JUMP = 0.3; // meters in a step beyond which a body jumps

/** Ball and robots as the robots know them between two frames, at a share of the step. */
function sensedBodies(replay, frame, next, share) {
  const body = (x, y, heading) => {
    const at = (name) => [frame, next].map((each) => replay.sensed(name, each));
    const [xs, ys] = [at(x), at(y)];
    const t = Math.hypot(xs[1] - xs[0], ys[1] - ys[0]) > SENSED_JUMP ? 0 : share;
    return {
      x: between(...xs, t),
      y: between(...ys, t),
      heading: heading && between(...at(heading), t),
    };
  };
  const robots = Array.from({ length: replay.robotCount }, (_, i) =>
    body(`x_${i}`, `y_${i}`, `heading_${i}`)
  );
  return { ball: body("ball_x", "ball_y"), robots };
}

/** Draw the ghosts of a moment. */
function drawGhosts(view, { sensed, robots }) {
  const { context, camera } = view;
  const { tints, opacity } = view.scene.ghosts;
  const width = (GHOST_PIXELS * view.density) / camera.scale;
  sensed.robots.forEach((body, index) => {
    if (!robots[index].absent) drawGhostRobot(view, body, index, width);
  });
  context.setTransform(...camera.matrix);
  context.strokeStyle = tints.ball;
  context.lineWidth = width;
  context.globalAlpha = opacity;
  context.beginPath();
  context.arc(sensed.ball.x, sensed.ball.y, view.ballRadius({ z: 0 }), 0, 2 * Math.PI);
  context.stroke();
  context.globalAlpha = 1;
}

/** Surface and outline of a robot, and a line to its front. */
function drawGhostRobot(view, { x, y, heading }, index, width) {
  const { context, scene } = view;
  const { tints, opacity, fill } = scene.ghosts;
  const outlines = view.outlinesOf(index);
  const { hull } = outlines;
  const growth = view.growth(outlines);
  const front = Math.max(...hull.filter((_, i) => i % 2 === 0));
  const [cos, sin] = [growth * Math.cos(heading), growth * Math.sin(heading)];
  context.setTransform(...view.camera.matrix);
  context.transform(cos, sin, -sin, cos, x, y);
  context.fillStyle = context.strokeStyle = index < scene.nBlue ? tints.blue : tints.yellow;
  context.lineWidth = width / growth;
  tracePolygon(context, hull);
  context.globalAlpha = fill;
  context.fill();
  context.globalAlpha = opacity;
  context.stroke();
  strokeLine(context, 0, 0, front - width, 0);
}
