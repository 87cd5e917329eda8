// The timeline of events and the chart of the reward terms, on canvases.

const TERM_COLORS = [
  "#3b82f6", "#f59e0b", "#10b981", "#ef4444", "#8b5cf6", "#06b6d4", "#ec4899", "#84cc16",
];

/** Prepare a canvas for drawing in CSS pixels; return its context, width and height. */
function prepare(canvas) {
  const density = Math.min(window.devicePixelRatio || 1, 2);
  const { width, height } = canvas.getBoundingClientRect();
  const [pixelWidth, pixelHeight] = [Math.round(width * density), Math.round(height * density)];
  if (canvas.width !== pixelWidth || canvas.height !== pixelHeight) {
    canvas.width = pixelWidth;
    canvas.height = pixelHeight;
  }
  const context = canvas.getContext("2d");
  context.setTransform(density, 0, 0, density, 0, 0);
  context.clearRect(0, 0, width, height);
  return { context, width, height };
}

/** Value of a CSS variable. */
function cssColor(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

/** The timeline: episodes, events and the playhead. */
class Timeline {
  constructor(canvas, replay, scene) {
    this.canvas = canvas;
    this.replay = replay;
    this.scene = scene;
    this.match = null; // what a referee decided
    this.labels = 0; // height of the names of parts of a match, under the track
    this.static = null;
  }

  forget() {
    this.static = null;
  }

  x(frame, width) {
    return 6 + (frame / Math.max(1, this.replay.frames - 1)) * (width - 12);
  }

  /** Frame at a distance from the left edge, CSS pixels. */
  frameAt(px) {
    const { width } = this.canvas.getBoundingClientRect();
    const share = (px - 6) / (width - 12);
    return Math.min(Math.max(share, 0), 1) * (this.replay.frames - 1);
  }

  /** Draw; the parts that stay are kept as a picture. */
  draw(time) {
    const { context, width, height: all } = prepare(this.canvas);
    const height = all - this.labels;
    if (!this.static || this.static.width !== this.canvas.width) {
      this.static = document.createElement("canvas");
      this.static.width = this.canvas.width;
      this.static.height = this.canvas.height;
      const picture = this.static.getContext("2d");
      picture.setTransform(context.getTransform());
      this.drawStatic(picture, width, height);
    }
    context.drawImage(this.static, 0, 0, width, all);
    const x = this.x(time, width);
    context.fillStyle = cssColor("--accent");
    context.globalAlpha = 0.22;
    context.fillRect(6, height / 2 - 4, x - 6, 8);
    context.globalAlpha = 1;
    context.fillRect(x - 1, 3, 2, height - 6);
    context.beginPath();
    context.arc(x, height / 2, 6, 0, 2 * Math.PI);
    context.fill();
  }

  drawStatic(context, width, height) {
    const { replay, scene } = this;
    const middle = height / 2;
    context.fillStyle = cssColor("--track");
    for (const episode of replay.header.episodes) {
      const [start, stop] = [this.x(episode.start, width), this.x(episode.stop - 1, width)];
      context.fillRect(start, middle - 4, Math.max(1, stop - start - 1), 8);
    }
    this.match?.drawOnTimeline(context, (frame) => this.x(frame, width), height);
    for (const [frame, kind, robot, detail] of replay.header.events) {
      const x = this.x(frame, width);
      if (kind === "goal") {
        context.fillStyle = scene.colors[detail];
        context.fillRect(x - 1.5, 4, 3, height - 8);
        context.beginPath();
        context.arc(x, 6, 5, 0, 2 * Math.PI);
        context.fill();
      } else if (this.match) {
        continue; // it has drawn all others
      } else if (kind === "kick" || kind === "touch") {
        const blue = robot.startsWith("blue");
        context.fillStyle = blue ? scene.colors.blue : scene.colors.yellow;
        const size = kind === "kick" ? 5 : 2;
        context.fillRect(x - size / 4, blue ? middle - 7 - size : middle + 7, size / 2, size);
      } else {
        context.fillStyle = cssColor("--soft");
        context.fillRect(x - 0.75, middle - 7, 1.5, 14);
      }
    }
  }
}

/** Sums of the reward terms of one robot over each episode. */
class RewardChart {
  constructor(canvas, replay) {
    this.canvas = canvas;
    this.replay = replay;
    this.sums = new Map(); // by observer: sums by term, each (frames,)
  }

  color(term) {
    return TERM_COLORS[this.replay.termNames.indexOf(term) % TERM_COLORS.length];
  }

  /** Sum of each term since the start of the episode, by frame. */
  sumsOf(observer) {
    const { replay } = this;
    if (!this.sums.has(observer)) {
      const sums = {};
      for (const name of replay.termNames) {
        const line = new Float32Array(replay.frames);
        let sum = 0;
        for (let frame = 0; frame < replay.frames; frame++) {
          sum = replay.starts[frame] ? 0 : sum + replay.term(name, observer, frame);
          line[frame] = sum;
        }
        sums[name] = line;
      }
      this.sums.set(observer, sums);
    }
    return this.sums.get(observer);
  }

  /** Draw the sums around a time, each episode from 0. */
  draw(observer, time) {
    const { context, width, height } = prepare(this.canvas);
    const { replay } = this;
    const sums = this.sumsOf(observer);
    const frame = Math.min(Math.floor(time), replay.frames - 1);
    const episode = replay.header.episodes[replay.episodeOf[frame]];
    const last = Math.max(episode.stop - 1, episode.start + 1);
    let [low, high] = [0, 0];
    for (const line of Object.values(sums)) {
      for (let i = episode.start; i < episode.stop; i++) {
        low = Math.min(low, line[i]);
        high = Math.max(high, line[i]);
      }
    }
    const range = high - low || 1;
    const left = 56; // fits "-0.0123"
    const x = (i) => left + ((i - episode.start) / (last - episode.start)) * (width - left - 6);
    const y = (value) => height - 8 - ((value - low) / range) * (height - 16);
    this.drawAxis(context, width, left, y, [0, high, low]);
    const stride = Math.max(1, Math.floor((episode.stop - episode.start) / (2 * width)));
    for (const [name, line] of Object.entries(sums)) {
      for (const [opacity, start, stop] of [[0.28, frame, episode.stop - 1], [1, episode.start, frame]]) {
        context.globalAlpha = opacity;
        context.strokeStyle = this.color(name);
        context.lineWidth = 1.7;
        context.lineJoin = "round";
        context.beginPath();
        context.moveTo(x(start), y(line[start]));
        for (let i = start + stride; i < stop; i += stride) context.lineTo(x(i), y(line[i]));
        context.lineTo(x(stop), y(line[stop]));
        context.stroke();
      }
    }
    context.globalAlpha = 1;
    context.fillStyle = cssColor("--soft");
    context.fillRect(x(Math.min(time, last)) - 0.5, 2, 1, height - 4);
  }

  drawAxis(context, width, left, y, values) {
    context.font = "11px system-ui, sans-serif";
    context.textAlign = "right";
    context.textBaseline = "middle";
    context.fillStyle = cssColor("--edge");
    context.fillRect(left, y(0) - 0.5, width - left - 6, 1);
    context.fillStyle = cssColor("--soft");
    const written = [];
    for (const value of values) {
      if (written.some((other) => Math.abs(other - y(value)) < 12)) continue;
      written.push(y(value));
      context.fillText(short(value), left - 6, y(value));
    }
  }
}

/** A number with about three digits. */
function short(value) {
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size < 1e-4 || size >= 1e5) return value.toExponential(1);
  return value.toFixed(size >= 100 ? 0 : size >= 10 ? 1 : size >= 0.1 ? 2 : 4);
}
