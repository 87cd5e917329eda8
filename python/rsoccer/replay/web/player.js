// The player: time, controls, panel. Starts with the last line.

const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4, 8];
const UNITS = {
  left: "rad/s", right: "rad/s", v_x: "m/s", v_y: "m/s", v_theta: "rad/s",
  kick_v_x: "m/s", kick_v_z: "m/s", dribbler: "", wheel_0: "rad/s", wheel_1: "rad/s",
  wheel_2: "rad/s", wheel_3: "rad/s",
};
const COMMAND_NAMES = {
  left: "left", right: "right", v_x: "ahead", v_y: "left", v_theta: "turn",
  kick_v_x: "kick", kick_v_z: "chip", dribbler: "dribbler",
};

const $ = (id) => document.getElementById(id);

function clockText(seconds) {
  const tenths = Math.floor(seconds * 10 + 1e-6);
  const rest = tenths % 600;
  return `${Math.floor(tenths / 600)}:${String(Math.floor(rest / 10)).padStart(2, "0")}.${rest % 10}`;
}

function capital(text) {
  return text.charAt(0).toUpperCase() + text.slice(1);
}

class Player {
  constructor(replay, scene, match) {
    this.replay = replay;
    this.scene = scene;
    this.match = match && new MatchView(replay, scene, match);
    this.time = 0; // in frames, with fractions
    this.playing = false;
    this.speed = 1;
    this.hold = 0; // seconds until play goes on after a goal
    this.lastTick = null;
    this.dirty = true;
    this.selected = 0;
    this.drawn = 0; // number of pictures, for tests
    this.view = new FieldView($("field"), replay, scene);
    this.timeline = new Timeline($("timeline"), replay, scene);
    this.chart = new RewardChart($("chart"), replay);
    if (this.match) {
      this.view.floor = new MatchFloor(replay, scene, match);
      this.timeline.match = this.match;
      this.timeline.labels = LABEL_HEIGHT;
    }
    this.robots = robotNames(replay, scene);
    this.goalFrames = new Set(replay.goals.map((goal) => goal.frame));
    this.fillTexts();
    this.fillEvents();
    this.connect();
    const paid = this.robots.indexOf(replay.header.observers[0]);
    this.select(Math.max(paid, 0));
    this.resize();
    this.tick = this.tick.bind(this);
    requestAnimationFrame(this.tick);
  }

  get last() {
    return this.replay.frames - 1;
  }

  // -- Time ------------------------------------------------------------------------------------

  /** Advance by the time since the last picture, and draw if something changed. */
  tick(now) {
    const elapsed = this.lastTick === null ? 0 : Math.min((now - this.lastTick) / 1000, 0.25);
    this.lastTick = now;
    if (this.playing) this.advance(elapsed);
    if (this.dirty) this.draw();
    requestAnimationFrame(this.tick);
  }

  /** Play on for some seconds of real time; goals hold the picture for a moment. */
  advance(elapsed) {
    this.dirty = true;
    if (this.hold > 0) {
      this.hold -= elapsed;
      return;
    }
    const next = this.time + (elapsed * this.speed) / this.scene.timeStep;
    for (let frame = Math.floor(this.time) + 1; frame <= Math.min(next, this.last); frame++) {
      if (this.goalFrames.has(frame)) {
        this.time = frame;
        this.hold = this.scene.goalPause / Math.max(this.speed, 1);
        return;
      }
    }
    this.time = next;
    if (this.time >= this.last) {
      this.time = this.last;
      this.pause();
    }
  }

  play() {
    if (this.time >= this.last) this.seek(0);
    this.playing = true;
    this.showPlaying();
  }

  pause() {
    this.playing = false;
    this.hold = 0;
    this.showPlaying();
  }

  showPlaying() {
    $("play").classList.toggle("playing", this.playing);
    $("play").setAttribute("aria-label", this.playing ? "Pause" : "Play");
    this.dirty = true;
  }

  toggle() {
    if (this.playing) this.pause();
    else this.play();
  }

  seek(frame) {
    this.time = Math.min(Math.max(frame, 0), this.last);
    this.hold = 0;
    this.dirty = true;
  }

  step(frames) {
    this.pause();
    this.seek((frames > 0 ? Math.floor(this.time) : Math.ceil(this.time)) + frames);
  }

  /** Go to the next event (1) or the one before (-1), touches left out. */
  jump(direction) {
    const frames = this.listed().map(([frame]) => frame);
    const now = Math.round(this.time);
    const found = direction > 0
      ? frames.find((frame) => frame > now)
      : frames.reverse().find((frame) => frame < now);
    this.seek(found ?? (direction > 0 ? this.last : 0));
  }

  setSpeed(speed) {
    this.speed = speed;
    $("speed").value = `${speed}\u00d7`;
  }

  changeSpeed(direction) {
    const index = SPEEDS.indexOf(this.speed) + direction;
    this.setSpeed(SPEEDS[Math.min(Math.max(index, 0), SPEEDS.length - 1)]);
  }

  // -- Drawing ---------------------------------------------------------------------------------

  resize() {
    const width = $("field").parentElement.clientWidth;
    const narrow = window.matchMedia("(max-width: 900px)").matches;
    const others = 215 + (this.match?.height ?? 0);
    const height = narrow ? 0.72 * window.innerHeight : window.innerHeight - others;
    this.view.resize(width, Math.max(height, 240));
    this.timeline.forget();
    this.dirty = true;
  }

  draw() {
    this.dirty = false;
    this.drawn += 1;
    const moment = this.view.draw(this.time);
    this.timeline.draw(this.time);
    this.showBoard(moment.frame);
    this.match?.show(moment.frame);
    this.showCaption(moment.frame);
    this.showNumbers(moment.frame);
    this.showRewards(moment.frame);
    this.showCurrentEvent(moment.frame);
    this.showTip(moment.frame);
  }

  fillTexts() {
    const { header } = this.replay;
    const teamName = (team) => (this.robots.some((name) => name.startsWith(team)) ? team : "\u2013");
    setText($("name-blue"), header.names[0] || teamName("blue"));
    setText($("name-yellow"), header.names[1] || teamName("yellow"));
    const duration = this.replay.clock(this.last, this.scene.timeStep);
    this.duration = clockText(duration);
    const facts = [
      header.task,
      `${this.duration.replace(/\.0$/, "")} of play`,
      ...this.scene.conditions,
      `rSoccer ${header.package}, physics ${header.physics}`,
    ];
    setText($("about"), facts.join(" \u00b7 "));
    for (const id of ["sensed", "sensed-key"]) $(id).hidden = !this.replay.sensedNumbers;
    $("timeline").setAttribute("aria-valuemax", String(this.last));
    for (const [index, name] of this.robots.entries()) {
      const option = document.createElement("option");
      option.value = String(index);
      option.textContent = name;
      $("robot").append(option);
    }
    $("rewards").hidden = !header.observers.length || !this.replay.termNames.length;
    for (const name of this.replay.termNames) {
      const row = document.createElement("tr");
      row.innerHTML = "<td><i></i><span></span></td><td></td><td></td>";
      row.querySelector("i").style.background = this.chart.color(name);
      row.querySelector("span").textContent = name;
      $("legend").append(row);
    }
  }

  showBoard(frame) {
    const score = this.match?.score(frame) ?? this.replay.score(frame);
    const seconds = this.replay.clock(frame, this.scene.timeStep);
    setText($("clock"), this.match?.clock(frame) ?? clockText(seconds));
    setText($("position"), `${clockText(seconds)} / ${this.duration}`);
    for (const team of ["blue", "yellow"]) {
      const goals = $(`goals-${team}`);
      setText(goals, String(score[team]));
      goals.classList.toggle("scored", this.scorer(frame) === team);
    }
    $("timeline").setAttribute("aria-valuenow", String(frame));
    $("timeline").setAttribute("aria-valuetext", clockText(seconds));
  }

  /** Team whose goal the frame shows. */
  scorer(frame) {
    return this.replay.goals.find((goal) => goal.frame === frame)?.team;
  }

  showCaption(frame) {
    const team = this.scorer(frame);
    $("caption").hidden = !team;
    $("caption").className = `caption ${team ?? ""}`;
    setText($("caption"), team ? "GOAL" : "");
  }

  /** Numbers of a robot: name, text. */
  numbersOf(index, frame) {
    const { replay } = this;
    const value = (name) => replay.robot(index, name, frame);
    const turns = value("heading") / (2 * Math.PI);
    if (value("absent") > 0) return [["on the field", "no"]];
    const degrees = Math.round(360 * (turns - Math.round(turns)));
    const speed = Math.hypot(value("v_x"), value("v_y"));
    const flags = [
      value("infrared") > 0 && "in beam",
      value("touched_ball") > 0 && "touched",
    ].filter(Boolean);
    const numbers = [
      ["x", `${fixed(value("x"), 2)} m`],
      ["y", `${fixed(value("y"), 2)} m`],
      ["heading", `${degrees}\u00b0`],
      ["speed", `${speed.toFixed(2)} m/s`],
      ["turning", `${fixed(value("v_theta"), 1)} rad/s`],
      ["ball", flags.join(", ") || "\u2013"],
    ];
    if (replay.sensedNumbers) numbers.push(["sensed", `${this.sensedError(index, frame)} mm off`]);
    replay.commandColumns.forEach((name, column) => {
      const digits = UNITS[name] === "m/s" ? 2 : 1;
      const text = fixed(replay.command(index, column, frame), digits);
      numbers.push([`\u2192 ${COMMAND_NAMES[name] ?? name}`, `${text} ${UNITS[name] ?? ""}`.trim()]);
    });
    return numbers;
  }

  /** Distance of a robot from where the robots believe it, mm. */
  sensedError(index, frame) {
    const { replay } = this;
    const [x, y] = ["x", "y"].map(
      (axis) => replay.robot(index, axis, frame) - replay.sensed(`${axis}_${index}`, frame)
    );
    return Math.round(1000 * Math.hypot(x, y));
  }

  rewardOf(index, frame) {
    const observer = this.replay.header.observers.indexOf(this.robots[index]);
    if (observer < 0) return null;
    return this.replay.termNames.reduce((sum, name) => sum + this.replay.term(name, observer, frame), 0);
  }

  showNumbers(frame) {
    const list = $("numbers");
    const numbers = this.numbersOf(this.selected, frame);
    while (list.children.length < numbers.length) {
      const row = document.createElement("div");
      row.append(document.createElement("dt"), document.createElement("dd"));
      list.append(row);
    }
    numbers.forEach(([name, text], i) => {
      setText(list.children[i].firstChild, name);
      setText(list.children[i].lastChild, text);
    });
    [...list.children].forEach((row, i) => {
      row.hidden = i >= numbers.length; // an absent robot has one number alone
    });
  }

  showRewards(frame) {
    if ($("rewards").hidden) return;
    const observer = this.replay.header.observers.indexOf(this.robots[this.selected]);
    $("chart").style.visibility = observer < 0 ? "hidden" : "";
    if (observer < 0) {
      setText($("reward-sum"), "none: the robot is not paid");
      for (const row of $("legend").rows) {
        setText(row.cells[1], "");
        setText(row.cells[2], "");
      }
      return;
    }
    this.chart.draw(observer, this.time);
    const sums = this.chart.sumsOf(observer);
    let total = 0;
    this.replay.termNames.forEach((name, i) => {
      const row = $("legend").rows[i];
      setText(row.cells[1], short(this.replay.term(name, observer, frame)));
      setText(row.cells[2], short(sums[name][frame]));
      total += sums[name][frame];
    });
    setText($("reward-sum"), short(total));
  }

  /** Numbers beside the robot under the pointer. */
  showTip(frame) {
    const index = this.view.hovered;
    $("tip").hidden = index < 0;
    if (index < 0) return;
    const reward = this.rewardOf(index, frame);
    const tip = $("tip");
    if (tip.dataset.robot !== this.robots[index]) {
      tip.dataset.robot = this.robots[index];
      tip.replaceChildren(document.createElement("b"), document.createElement("span"));
      tip.firstChild.textContent = this.robots[index];
    }
    const rows = this.numbersOf(index, frame);
    if (reward !== null) rows.push(["reward", short(reward)]);
    setText(tip.lastChild, rows.map(([name, text]) => `${name}: ${text}`).join("\n"));
    const { clientWidth, clientHeight } = tip.parentElement;
    const [x, y] = this.pointer;
    const left = x + 30 + tip.offsetWidth > clientWidth ? x - 30 - tip.offsetWidth : x + 30;
    tip.style.left = `${Math.max(0, left)}px`;
    tip.style.top = `${Math.max(0, Math.min(y - 20, clientHeight - tip.offsetHeight))}px`;
  }

  // -- Events ----------------------------------------------------------------------------------

  /** Events of the list; touches only on request. */
  listed() {
    if (this.match) return this.match.listed($("touches").checked);
    const all = this.replay.header.events;
    return $("touches").checked ? all : all.filter(([, kind]) => kind !== "touch");
  }

  fillEvents() {
    const items = this.listed().map(([frame, kind, robot, detail]) => {
      const button = document.createElement("button");
      button.dataset.frame = String(frame);
      const time = document.createElement("time");
      time.textContent = clockText(this.replay.clock(frame, this.scene.timeStep));
      const dot = document.createElement("i");
      dot.className = kind === "goal" ? detail : robot.split("_")[0];
      const text = document.createElement("span");
      text.textContent = this.match?.eventText(kind, robot, detail) ?? eventText(kind, robot, detail);
      this.match?.decorate(button, dot, kind, detail);
      button.append(time, dot, text);
      button.addEventListener("click", () => this.seek(frame));
      const item = document.createElement("li");
      item.append(button);
      return item;
    });
    $("events").replaceChildren(...items);
    this.current = null;
  }

  /** Mark the last event before a frame, and keep it in view within the list. */
  showCurrentEvent(frame) {
    const list = $("events");
    let current = null;
    for (const item of list.children) {
      if (Number(item.firstChild.dataset.frame) <= frame) current = item;
      else break;
    }
    if (current === this.current) return;
    this.current?.firstChild.removeAttribute("aria-current");
    current?.firstChild.setAttribute("aria-current", "true");
    this.current = current;
    if (current) list.scrollTop = current.offsetTop - list.offsetTop - list.clientHeight / 2;
  }

  // -- Input -----------------------------------------------------------------------------------

  select(index) {
    this.selected = index;
    this.view.selected = index;
    $("robot").value = String(index);
    this.dirty = true;
  }

  zoom() {
    this.view.nextZoom();
    $("zoom").setAttribute("aria-pressed", String(this.view.zoomed));
    this.dirty = true;
  }

  toggleTrails() {
    this.view.trails = !this.view.trails;
    $("trails").setAttribute("aria-pressed", String(this.view.trails));
    this.dirty = true;
  }

  toggleGhosts() {
    this.view.ghosts = !this.view.ghosts;
    $("sensed").setAttribute("aria-pressed", String(this.view.ghosts));
    this.dirty = true;
  }

  toggleTheme() {
    const root = document.documentElement;
    const system = window.matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light";
    const now = root.dataset.theme ?? system;
    root.dataset.theme = now === "dark" ? "light" : "dark";
    this.timeline.forget();
    this.dirty = true;
  }

  connect() {
    const actions = {
      first: () => this.seek(0),
      back: () => this.step(-1),
      play: () => this.toggle(),
      forward: () => this.step(1),
      last: () => this.seek(this.last),
      slower: () => this.changeSpeed(-1),
      faster: () => this.changeSpeed(1),
      zoom: () => this.zoom(),
      trails: () => this.toggleTrails(),
      sensed: () => this.toggleGhosts(),
      theme: () => this.toggleTheme(),
      help: () => $("keys").showModal(),
    };
    for (const [id, action] of Object.entries(actions)) $(id).addEventListener("click", action);
    $("robot").addEventListener("change", (event) => this.select(Number(event.target.value)));
    $("touches").addEventListener("change", () => {
      this.fillEvents();
      this.dirty = true;
    });
    window.addEventListener("resize", () => this.resize());
    window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
      this.timeline.forget();
      this.dirty = true;
    });
    document.addEventListener("keydown", (event) => this.key(event));
    // A button that was clicked gives the keyboard back to the player; one reached by Tab keeps it.
    document.addEventListener("click", (event) => {
      if (event.detail > 0) event.target.closest("button, input")?.blur();
    });
    this.connectTimeline();
    this.connectField();
  }

  connectTimeline() {
    const canvas = $("timeline");
    const scrub = (event) => {
      this.seek(this.timeline.frameAt(event.clientX - canvas.getBoundingClientRect().left));
    };
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      this.resumes = this.playing;
      this.pause();
      scrub(event);
    });
    canvas.addEventListener("pointermove", (event) => {
      if (canvas.hasPointerCapture(event.pointerId)) scrub(event);
    });
    const release = () => {
      if (this.resumes) this.play();
      this.resumes = false;
    };
    canvas.addEventListener("pointerup", release);
    canvas.addEventListener("pointercancel", release);
  }

  connectField() {
    const canvas = $("field");
    const hover = (event) => {
      const box = canvas.getBoundingClientRect();
      this.pointer = [event.clientX - box.left, event.clientY - box.top];
      this.view.hovered = this.view.robotAt(...this.pointer, this.time);
      this.dirty = true;
    };
    canvas.addEventListener("pointermove", hover);
    canvas.addEventListener("pointerdown", (event) => {
      hover(event);
      if (this.view.hovered >= 0) this.select(this.view.hovered);
    });
    canvas.addEventListener("pointerleave", () => {
      this.view.hovered = -1;
      this.dirty = true;
    });
  }

  key(event) {
    const inField = event.target.closest?.("select, input, dialog");
    const pressesButton = event.key === " " && event.target.closest?.("button");
    if (event.ctrlKey || event.metaKey || event.altKey || inField || pressesButton) return;
    const second = Math.round(1 / this.scene.timeStep);
    const actions = {
      " ": () => this.toggle(),
      ArrowLeft: () => this.step(event.shiftKey ? -second : -1),
      ArrowRight: () => this.step(event.shiftKey ? second : 1),
      Home: () => this.seek(0),
      End: () => this.seek(this.last),
      "+": () => this.changeSpeed(1),
      "=": () => this.changeSpeed(1),
      "-": () => this.changeSpeed(-1),
      n: () => this.jump(1),
      p: () => this.jump(-1),
      z: () => this.zoom(),
      t: () => this.toggleTrails(),
      s: () => this.toggleGhosts(),
      d: () => this.toggleTheme(),
      "?": () => $("keys").showModal(),
    };
    const action = actions[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!action) return;
    event.preventDefault();
    action();
  }
}

/** A number with some digits after the point, and no sign before zero. */
function fixed(value, digits) {
  return value.toFixed(digits).replace(/^-(?=[0.]*$)/, "");
}

function setText(element, text) {
  if (element.textContent !== text) element.textContent = text;
}

function robotNames(replay, scene) {
  return Array.from({ length: replay.robotCount }, (_, i) =>
    i < scene.nBlue ? `blue_${i}` : `yellow_${i - scene.nBlue}`
  );
}

function eventText(kind, robot, detail) {
  const by = robot ? `, ${robot}` : "";
  if (kind === "goal") return `Goal for ${detail}${by}`;
  if (kind === "out") return `Out over the ${detail.replace(/_/g, " ")}${by}`;
  if (kind === "pass") return `Pass to ${robot}`;
  if (kind === "end") return `End of the episode, ${detail}`;
  return `${capital(kind.replace(/_/g, " "))}${by}`;
}

/** Read the replay in the page, and play it unless the page is part of another. */
async function start() {
  const scene = JSON.parse($("scene").textContent);
  const match = JSON.parse($("match").textContent);
  const replay = await readReplay(bytesOf($("replay").textContent.trim()));
  const player = new Player(replay, scene, match);
  $("message").hidden = true;
  const calm = window.matchMedia("(prefers-reduced-motion: reduce)").matches;
  if (window.self === window.top && !calm) player.play();
  return player;
}

// Scripts of other pages, and tests, reach the player by this name.
window.rsoccerPlayer = start();
window.rsoccerPlayer.catch((error) => {
  $("message").textContent = `The replay cannot be shown: ${error.message}.`;
});
