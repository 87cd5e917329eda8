// The playground: choices, the loop of steps and pictures, pointers.

const STEP = 0.025; // seconds of a control step
const BUDGET = 10; // milliseconds of a picture in which steps may be played
const SPEEDS = [["0.25", "¼ ×"], ["0.5", "½ ×"], ["1", "1 ×"], ["2", "2 ×"], ["4", "4 ×"], ["0", "fastest"]];
const THROW = 6; // m/s, the fastest ball that a drag throws
const MOST_EVENTS = 60;

const $ = (id) => document.getElementById(id);

class Playground {
  constructor(engine, data) {
    this.engine = engine;
    this.data = data;
    this.inputs = new Inputs(data.keys);
    this.files = {}; // dropped policies by name
    this.choices = defaultChoices(data.leagues);
    this.driven = -1;
    this.paused = false;
    this.debt = 0; // seconds of play that are due
    this.played = 0; // steps since the rate was shown
    this.stepTime = 0; // milliseconds that these took
    this.stepped = 0;
    this.pictures = 0;
    this.last = null;
    this.drag = null;
    this.panel = new ConditionsPanel($("sliders"), () => this.changeConditions());
    fill($("speed"), SPEEDS, "1");
    this.fillChoices();
    this.listen();
  }

  get league() {
    return this.data.leagues.find((league) => league.id === this.choices.league);
  }

  // -- Choices -----------------------------------------------------------------------------------

  fillChoices() {
    fill($("league"), this.data.leagues.map((league) => [league.id, league.name]), this.choices.league);
    this.fillSides();
  }

  fillSides() {
    const options = [
      ...(this.league.scripted ? [["scripted", "scripted"]] : []),
      ...this.league.policies.map(({ id, name }) => [id, name]),
      ...Object.keys(this.files).map((name) => [`file:${name}`, name]),
      ["idle", "nobody"],
    ];
    for (const team of [0, 1]) {
      const known = options.some(([id]) => id === this.choices.sides[team]);
      if (!known) this.choices.sides[team] = options[0][0];
      fill($(`side-${team}`), options, this.choices.sides[team]);
    }
    this.showSkills();
  }

  showSkills() {
    for (const team of [0, 1]) {
      $(`skill-row-${team}`).hidden = this.choices.sides[team] !== "scripted";
      $(`skill-${team}`).value = this.choices.skills[team];
      $(`skill-row-${team}`).querySelector("output").textContent = Number(this.choices.skills[team]).toFixed(2);
    }
  }

  /** Begin the match of the choices; with numbers, go on from their situation. */
  begin(numbers = null) {
    const { league, choices, data } = this;
    const count = league.robots;
    const setup = { field: league.field, play: league.play, blue: count, yellow: count, seed: choices.seed, conditions: conditionsOf(choices.conditions) };
    const created = this.engine.newMatch(setup);
    try {
      for (const team of [0, 1]) this.giveSide(created, team);
      if (numbers?.length) created.resume(numbers);
    } catch (error) {
      created.remove(); // the match before goes on
      throw error;
    }
    this.match?.remove();
    this.match = created;
    this.showNames();
    const scene = data.scenes[league.field];
    this.scene = { ...scene, nBlue: count, robots: new Array(2 * count).fill(scene.robots[0]) };
    this.report = this.match.report();
    this.live = new LiveRows(this.engine.names, 2 * count, this.report);
    this.live.begin(this.match.row("state"), this.sensed(), this.report);
    this.recorder = new Recorder(this.engine.names, data.steps, 2 * count);
    this.record([]);
    this.view = new FieldView($("field"), this.live, this.scene);
    this.floorMarks = { ...data.floor, areas: data.areas[league.field], marks: [[0, null, "", null]] };
    this.view.floor = new MatchFloor(this.live, this.scene, this.floorMarks);
    this.drive(-1);
    this.listRobots();
    $("events").replaceChildren();
    this.debt = 0;
    this.resize();
    this.showState();
    $("message").hidden = true;
  }

  setSide(team) {
    this.giveSide(this.match, team);
    this.showNames();
  }

  giveSide(match, team) {
    const { choices } = this;
    const side = choices.sides[team];
    if (side === "scripted") match.setScripted(team, Number(choices.skills[team]));
    else if (side === "idle") match.setIdle(team);
    else match.setPolicy(team, this.files[side.slice(5)] ?? this.policyFile(side));
  }

  showNames() {
    for (const [team, id] of ["name-blue", "name-yellow"].entries()) $(id).textContent = $(id).title = this.sideName(team);
  }

  policyFile(id) {
    const found = this.league.policies.find((policy) => policy.id === id);
    found.bytes ??= fromBase64(this.data.files[found.file]);
    return found.bytes;
  }

  sideName(team) {
    const side = this.choices.sides[team];
    if (side === "idle") return "nobody";
    if (side === "scripted") return `scripted ${Number(this.choices.skills[team]).toFixed(2)}`;
    const policy = this.league.policies.find(({ id }) => id === side);
    return policy?.name ?? side.replace(/^file:/, "");
  }

  /** Run an action, and show its error where it fails. */
  attempt(action) {
    try {
      action();
      $("message").hidden = true;
      return true;
    } catch (error) {
      this.say(error.message);
      return false;
    }
  }

  say(text) {
    $("message").textContent = text;
    $("message").hidden = false;
  }

  chooseSide(team, side) {
    const before = this.choices.sides[team];
    this.choices.sides[team] = side;
    if (!this.attempt(() => this.setSide(team))) {
      this.choices.sides[team] = before;
      $(`side-${team}`).value = before;
    }
    this.showSkills();
  }

  changeConditions() {
    this.choices.conditions = { ...this.panel.values };
    this.attempt(() => this.match.change(conditionsOf(this.choices.conditions)));
    this.live.begin(this.match.row("state"), this.sensed(), this.match.report());
  }

  get hasSenses() {
    return seesThroughCameras(this.choices.conditions);
  }

  sensed() {
    return this.hasSenses ? this.match.row("blue") : null;
  }

  /** Let blue play a policy file; one that cannot play here is not kept. */
  addPolicy(name, bytes) {
    if (!this.attempt(() => this.match.setPolicy(0, bytes))) return;
    this.files[name] = bytes;
    this.choices.sides[0] = `file:${name}`;
    this.fillSides();
    this.showNames();
  }

  // -- A person ----------------------------------------------------------------------------------

  listRobots() {
    const count = this.league.robots;
    const names = [["-1", "no robot"]];
    for (let i = 0; i < 2 * count; i++) names.push([String(i), i < count ? `blue ${i}` : `yellow ${i - count}`]);
    fill($("driven"), names, String(this.driven));
  }

  drive(robot) {
    if (this.driven >= 0 && this.driven !== robot) this.match.control(this.driven, null);
    this.driven = robot;
    this.view.selected = robot;
    $("driven").value = String(robot);
    for (const id of ["stick", "kicks"]) $(id).classList.toggle("on", robot >= 0);
    $("kicks").hidden = !this.league.scripted; // robots of VSSS have no kicker
  }

  /** The blue robot that is nearest to the ball. */
  nearest() {
    const { live } = this;
    const last = live.frames - 1;
    let [best, least] = [0, Infinity];
    for (let i = 0; i < this.league.robots; i++) {
      const distance = Math.hypot(live.robot(i, "x", last) - live.ball("x", last), live.robot(i, "y", last) - live.ball("y", last));
      if (!live.robot(i, "absent", last) && distance < least) [best, least] = [i, distance];
    }
    return best;
  }

  control() {
    if (this.driven < 0 && this.inputs.active) this.drive(this.nearest());
    if (this.driven < 0) return;
    const heading = this.live.robot(this.driven, "heading", this.live.frames - 1);
    this.match.control(this.driven, this.inputs.controls(heading, !this.league.scripted));
  }

  // -- Loop --------------------------------------------------------------------------------------

  step() {
    this.control();
    const begun = performance.now();
    const decided = this.match.step();
    this.stepTime += performance.now() - begun;
    this.stepped += 1;
    this.played += 1;
    this.report = this.match.report();
    this.live.add(this.match.row("state"), this.sensed(), this.report);
    const goals = decided ? this.report.events.filter(({ kind }) => kind === "GOAL") : [];
    this.record(goals.map(({ team }) => ["blue", "yellow"][team]));
    if (decided) this.listEvents();
  }

  record(goals) {
    const headings = this.live.headings[this.live.frames - 1];
    this.recorder.add(this.live.newest, headings, this.match.row("commands"), goals);
  }

  picture(now) {
    const elapsed = this.last === null ? 0 : Math.min((now - this.last) / 1000, 0.1);
    this.last = now;
    const speed = Number($("speed").value);
    if (!this.paused && !document.hidden) {
      this.debt += speed ? elapsed * speed : Infinity;
      const until = performance.now() + BUDGET;
      try {
        while (this.debt >= STEP && performance.now() < until) {
          this.step();
          this.debt -= STEP;
        }
      } catch (error) {
        this.paused = true;
        this.say(`The match cannot go on: ${error.message}`);
      }
      this.debt = Math.min(this.debt, STEP); // what did not fit is left out
      this.showState();
    }
    const { frames } = this.live;
    const share = speed && !this.paused ? Math.min(this.debt / STEP, 1) : 1;
    this.view.draw(frames - 2 + share);
    this.pictures += 1;
    requestAnimationFrame((time) => this.picture(time));
  }

  showRate() {
    const rate = this.stepTime ? Math.round((1000 * this.stepped) / this.stepTime) : 0;
    $("rate").textContent = `${this.played} steps/s · ${this.pictures} pictures/s · up to ${rate.toLocaleString("en")} steps/s`;
    this.rate = { played: this.played, pictures: this.pictures, possible: rate };
    [this.played, this.pictures] = [0, 0];
    if (this.stepped > 4000) [this.stepped, this.stepTime] = [0, 0];
  }

  showState() {
    const { report } = this;
    $("goals-blue").textContent = report.score[0];
    $("goals-yellow").textContent = report.score[1];
    $("clock").textContent = timeLeft(report.seconds_left || (report.stage.endsWith("_PRE") ? this.data.halfSeconds : 0));
    $("stage").textContent = this.league.play === "self_play" ? "until a goal" : stageText(report);
    $("command").textContent = commandText(report);
    $("play").textContent = this.paused ? "Play" : "Pause";
    const team = sideOf(report.command === "NORMAL_START" || report.command === "STOP" ? report.kick : report.command);
    const stopped = !report.in_play && report.command !== "FORCE_START" && report.stage !== "POST_GAME";
    const keeps = stopped && this.league.scripted ? "disc" : null;
    this.floorMarks.marks[0] = [0, keeps, team, stopped ? team : null];
  }

  listEvents() {
    const { report } = this;
    const seconds = report.steps * STEP;
    for (const event of report.events) {
      const time = newElement("time", "", timeLeft(seconds));
      const text = newElement("span", "", eventText(event, this.league.robots));
      $("events").prepend(newElement("li", "", time, text));
    }
    while ($("events").children.length > MOST_EVENTS) $("events").lastChild.remove();
  }

  resize() {
    const width = $("field").parentElement.clientWidth;
    this.view.resize(width, Math.max(window.innerHeight - 130, 240));
  }

  // -- Links and files ---------------------------------------------------------------------------

  /** Begin the match of a link. Defaults replace what it has wrong, and the page says what that is. */
  restore(text) {
    const shared = readSituation(text);
    const { choices, wrong } = checkedChoices(shared?.choices ?? {}, this.data.leagues);
    if (!shared && text.length > 1) {
      wrong.push("it is not complete");
      if (this.match) Object.assign(choices, this.choices); // a match goes on
    }
    this.choices = choices;
    this.panel.set(choices.conditions);
    this.fillChoices();
    try {
      if (shared || !this.match) this.begin(shared?.numbers);
    } catch (error) {
      wrong.push(error.message);
      this.begin();
    }
    if (wrong.length) this.say(`Not all of the link can be shown: ${wrong.join("; ")}`);
  }

  /** End of an address that shows this situation. */
  link() {
    return situationText(this.choices, this.match.situation());
  }

  async share() {
    history.replaceState(null, "", this.link());
    try {
      await navigator.clipboard.writeText(location.href);
      this.say("The link is copied");
    } catch {
      this.say("The link is in the address bar");
    }
    setTimeout(() => ($("message").hidden = true), 2500);
  }

  /** Bytes of a replay file of the last minutes. */
  replayFile() {
    const { league, data } = this;
    const names = [0, 1].map((team) => this.sideName(team).toUpperCase());
    const controllers = {};
    for (let i = 0; i < 2 * league.robots; i++) {
      const [team, name] = i < league.robots ? [0, `blue_${i}`] : [1, `yellow_${i - league.robots}`];
      controllers[name] = this.controllerName(team);
    }
    return this.recorder.file({
      package: data.version,
      physics: this.engine.exports.physics_version(),
      task: league.task,
      controllers,
      names,
      config: this.match.configuration(),
      commandColumns: data.commandColumns[league.scripted ? "omni" : "differential"],
    });
  }

  /** Name of a side's policy in Python; null for a trained one, which has none for this task. */
  controllerName(team) {
    const { sides, skills } = this.choices;
    if (sides[team] === "idle") return "zero";
    return sides[team] === "scripted" ? `scripted:${skills[team]}` : null;
  }

  async save() {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([await this.replayFile()]));
    link.download = `playground-${this.league.id}.rsr`;
    link.click();
    URL.revokeObjectURL(link.href);
  }

  // -- Events of the page ------------------------------------------------------------------------

  listen() {
    window.addEventListener("resize", () => this.resize());
    window.addEventListener("hashchange", () => this.restore(location.hash));
    $("league").addEventListener("change", (event) => {
      const before = this.choices;
      this.choices = { ...before, league: event.target.value, sides: [null, null] };
      this.fillSides();
      if (this.attempt(() => this.begin())) return;
      this.choices = before;
      this.fillChoices();
    });
    for (const team of [0, 1]) {
      $(`side-${team}`).addEventListener("change", (event) => this.chooseSide(team, event.target.value));
      $(`skill-${team}`).addEventListener("input", (event) => {
        this.choices.skills[team] = Number(event.target.value);
        this.showSkills();
      });
      $(`skill-${team}`).addEventListener("change", () => this.attempt(() => this.setSide(team)));
    }
    $("driven").addEventListener("change", (event) => this.drive(Number(event.target.value)));
    $("play").addEventListener("click", () => this.togglePause());
    $("restart").addEventListener("click", () => this.newMatch());
    $("ideal").addEventListener("click", () => {
      this.panel.set({});
      this.changeConditions();
    });
    $("share").addEventListener("click", () => this.share());
    $("save").addEventListener("click", () => this.save().catch((error) => this.say(error.message)));
    $("policy").addEventListener("change", (event) => this.readFiles(event.target.files));
    this.listenToFocus();
    this.listenToKeys();
    this.listenToPointers();
    this.listenToDrops();
    setInterval(() => this.showRate(), 1000);
  }

  togglePause() {
    this.paused = !this.paused;
    this.showState();
  }

  newMatch() {
    this.choices.seed += 1;
    this.attempt(() => this.begin());
  }

  /** A choice by pointer gives the keyboard back to the robot; one by keys keeps it, to go on with them. */
  listenToFocus() {
    let keyed = false;
    document.addEventListener("pointerdown", () => (keyed = false), true);
    document.addEventListener("keydown", () => (keyed = true), true);
    for (const kind of ["change", "click"]) {
      document.addEventListener(kind, (event) => {
        const chosen = event.target.closest(kind === "click" ? "button" : "select, input");
        if (chosen && !keyed) chosen.blur();
      });
    }
  }

  listenToKeys() {
    window.addEventListener("keydown", (event) => {
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      const key = event.key.toLowerCase();
      const control = event.target.closest?.("select, input, button");
      if (control && event.key === "Escape") control.blur();
      const pressesButton = control?.tagName === "BUTTON" && (key === " " || key === "enter");
      if (pressesButton || (control && control.tagName !== "BUTTON")) return;
      const robots = 2 * this.league.robots;
      const { commands } = this.data.keys;
      let action = null;
      if (key === commands.next_robot && this.driven >= 0) action = () => this.drive((this.driven + 1) % robots);
      else if (key === commands.pause) action = () => this.togglePause();
      else if (key === commands.reset) action = () => this.newMatch();
      else if (key === "escape") action = () => this.drive(-1);
      else if (this.inputs.has(key)) action = () => this.inputs.press(key);
      if (!action) return;
      event.preventDefault();
      if (!event.repeat) action(); // a key that is held acts once
    });
    window.addEventListener("keyup", (event) => this.inputs.release(event.key));
    window.addEventListener("blur", () => this.inputs.releaseAll());
  }

  listenToPointers() {
    const canvas = $("field");
    const place = (event) => {
      const box = canvas.getBoundingClientRect();
      const { density, camera } = this.view;
      return camera.toWorld((event.clientX - box.left) * density, (event.clientY - box.top) * density);
    };
    canvas.addEventListener("pointerdown", (event) => {
      const [x, y] = place(event);
      const box = canvas.getBoundingClientRect();
      const last = this.live.frames - 1;
      const robot = this.view.robotAt(event.clientX - box.left, event.clientY - box.top, last);
      const toBall = Math.hypot(this.live.ball("x", last) - x, this.live.ball("y", last) - y);
      const reach = (18 * this.view.density) / this.view.camera.scale;
      const body = toBall < reach ? 0 : robot + 1;
      if (body === 0 && toBall >= reach) return;
      canvas.setPointerCapture(event.pointerId);
      this.drag = { body, x, y, moved: false, vx: 0, vy: 0, at: event.timeStamp };
    });
    canvas.addEventListener("pointermove", (event) => {
      const { drag } = this;
      if (!drag) return;
      const [x, y] = place(event);
      const pixels = (Math.hypot(x - drag.x, y - drag.y) * this.view.camera.scale) / this.view.density;
      if (!drag.moved && pixels < 5) return;
      drag.moved = true;
      const seconds = Math.max(event.timeStamp - drag.at, 1) / 1000;
      [drag.vx, drag.vy] = [(x - drag.x) / seconds, (y - drag.y) / seconds];
      [drag.x, drag.y, drag.at] = [x, y, event.timeStamp];
      if (this.match.move(drag.body, x, y)) this.live.add(this.match.row("state"), this.sensed(), this.report);
    });
    const end = (event) => {
      const { drag } = this;
      this.drag = null;
      if (!drag) return;
      if (!drag.moved && drag.body > 0) this.drive(drag.body - 1 === this.driven ? -1 : drag.body - 1);
      const fast = Math.hypot(drag.vx, drag.vy);
      // A ball that is let go in motion is thrown.
      if (drag.moved && drag.body === 0 && fast > 0.3 && event.timeStamp - drag.at < 80) {
        const limit = Math.min(1, THROW / fast);
        this.match.move(0, drag.x, drag.y, drag.vx * limit, drag.vy * limit);
      }
    };
    canvas.addEventListener("pointerup", end);
    canvas.addEventListener("pointercancel", () => (this.drag = null));
    this.listenToStick();
  }

  listenToStick() {
    const stick = $("stick");
    const move = (event) => {
      const box = stick.getBoundingClientRect();
      const [dx, dy] = [(event.clientX - box.left) / box.width - 0.5, (event.clientY - box.top) / box.height - 0.5];
      const size = Math.max(1, Math.hypot(dx, dy) * 2);
      const [right, up] = [(2 * dx) / size, (-2 * dy) / size];
      stick.firstChild.style.transform = `translate(${right * 35}px, ${-up * 35}px)`;
      // Where the field stands upright, +x points up.
      this.inputs.stick = this.view.camera.upright ? { x: up, y: -right } : { x: right, y: up };
    };
    const end = () => {
      this.inputs.stick = null;
      stick.firstChild.style.transform = "";
    };
    stick.addEventListener("pointerdown", (event) => {
      stick.setPointerCapture(event.pointerId);
      move(event);
    });
    stick.addEventListener("pointermove", (event) => {
      if (stick.hasPointerCapture(event.pointerId)) move(event);
    });
    stick.addEventListener("pointerup", end);
    stick.addEventListener("pointercancel", end);
    for (const name of ["kick", "chip"]) {
      const button = $(`touch-${name}`);
      button.addEventListener("pointerdown", () => (this.inputs.buttons[name] = true));
      for (const over of ["pointerup", "pointercancel", "pointerleave"]) {
        button.addEventListener(over, () => (this.inputs.buttons[name] = false));
      }
    }
  }

  listenToDrops() {
    const dropping = (on) => document.body.classList.toggle("dropping", on);
    window.addEventListener("dragover", (event) => {
      event.preventDefault();
      dropping(true);
    });
    window.addEventListener("dragleave", (event) => {
      if (!event.relatedTarget) dropping(false);
    });
    window.addEventListener("drop", (event) => {
      event.preventDefault();
      dropping(false);
      this.readFiles(event.dataTransfer.files);
    });
  }

  async readFiles(files) {
    for (const file of files) this.addPolicy(file.name, new Uint8Array(await file.arrayBuffer()));
  }
}

function fill(select, options, value) {
  select.replaceChildren(...options.map(([id, name]) => Object.assign(document.createElement("option"), { value: id, textContent: name })));
  select.value = value;
}

/** Bytes of the module, which the page has compressed. */
async function moduleBytes() {
  const packed = fromBase64($("module").textContent.trim());
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

async function start() {
  const engine = await Engine.start(await moduleBytes());
  const playground = new Playground(engine, JSON.parse($("data").textContent));
  playground.restore(location.hash);
  requestAnimationFrame((time) => playground.picture(time));
  return playground;
}

// Tests reach the page by this name.
window.rsoccerPlayground = start();
window.rsoccerPlayground.catch((error) => {
  $("message").textContent = `The playground cannot start: ${error.message}`;
  $("message").hidden = false;
});
