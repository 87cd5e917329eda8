// A match with a referee: score board, ticker, statistics, and the events that it decided.

const LABEL_HEIGHT = 13; // of the names of parts of the match, CSS pixels
const MORE_HEIGHT = 60; // of ticker and timeline, CSS pixels

/** The entry of a list by frame that holds at a frame: its frame and values. */
function valueAt(list, frame) {
  let [low, high] = [0, list.length - 1];
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (list[middle][0] <= frame) low = middle;
    else high = middle - 1;
  }
  return list[low];
}

function newElement(tag, className, ...children) {
  const element = document.createElement(tag);
  if (className) element.className = className;
  element.append(...children);
  return element;
}

/** Minutes and seconds that are left; the last second ends at 0:00. */
function timeLeft(seconds) {
  const whole = Math.max(0, Math.ceil(seconds - 1e-3));
  return `${Math.floor(whole / 60)}:${String(whole % 60).padStart(2, "0")}`;
}

class MatchView {
  constructor(replay, scene, match) {
    this.replay = replay;
    this.scene = scene;
    this.match = match;
    this.height = MORE_HEIGHT;
    this.fouls = this.countedFouls();
    this.hasCards = replay.header.events.some(([, kind]) => /card$/.test(kind));
    this.makeBoard();
    this.makeTicker();
    this.makeStatistics();
    const all = document.getElementById("touches").parentElement;
    all.lastChild.textContent = " all";
    all.title = "Kicks, passes and touches too";
    document.querySelector("main").classList.add("match");
  }

  number(name, frame) {
    return this.replay.referee(name, frame);
  }

  /** Numbers of blue and of yellow. */
  pair(name, frame) {
    return ["blue", "yellow"].map((team) => this.number(`${name}_${team}`, frame));
  }

  score(frame) {
    const [blue, yellow] = this.pair("score", frame);
    return { blue, yellow };
  }

  /** Text of the clock: time left, or the part of the match if it has no duration. */
  clock(frame) {
    const [, stage, hasClock] = valueAt(this.match.stages, frame);
    return hasClock ? timeLeft(this.number("seconds_left", frame)) : capital(stage);
  }

  // -- Score board -----------------------------------------------------------------------------

  makeBoard() {
    const clock = $("clock");
    this.stage = newElement("small", "stage");
    const middle = newElement("span", "middle");
    clock.replaceWith(middle);
    middle.append(this.stage, clock);
    this.sides = ["blue", "yellow"].map((team) => {
      const name = $(`name-${team}`);
      const side = newElement("span", name.className);
      name.className = "name";
      name.replaceWith(side);
      const robots = newElement("span", "pips");
      const count = team === "blue" ? this.scene.nBlue : this.replay.robotCount - this.scene.nBlue;
      for (let i = 0; i < count; i++) robots.append(newElement("i"));
      const cards = ["yellow-card", "red-card"].map((kind) => newElement("b", `referee-card ${kind}`));
      const row = newElement("span", "row", ...(team === "blue" ? [robots, ...cards] : [...cards, robots]));
      side.append(name, row);
      return { team, robots, cards };
    });
  }

  showBoard(frame) {
    const [, stage, hasClock] = valueAt(this.match.stages, frame);
    this.stage.hidden = !hasClock;
    setText(this.stage, stage);
    for (const { team, robots, cards } of this.sides) {
      const first = team === "blue" ? 0 : this.scene.nBlue;
      const pips = [...robots.children];
      const absent = pips.map((_, i) => this.replay.robot(first + i, "absent", frame) > 0);
      pips.forEach((pip, i) => pip.classList.toggle("absent", absent[i]));
      robots.title = `${absent.filter((is) => !is).length} robots on the field`;
      cards.forEach((card, i) => {
        const count = this.number(`${i ? "red" : "yellow"}_cards_${team}`, frame);
        card.hidden = !count;
        card.title = `${i ? "Red" : "Yellow"} cards: ${count}`;
        setText(card, String(count));
      });
    }
  }

  // -- Ticker ----------------------------------------------------------------------------------

  makeTicker() {
    this.command = newElement("span");
    this.announcement = newElement("span");
    const ticker = newElement("div", "ticker", this.command, this.announcement);
    ticker.setAttribute("role", "status");
    ticker.setAttribute("aria-live", "off");
    document.querySelector(".view").append(ticker);
  }

  showTicker(frame) {
    const shown = [
      [this.command, this.match.commands],
      [this.announcement, this.match.announcements],
    ];
    for (const [plate, list] of shown) {
      const [, text, team] = valueAt(list, frame);
      plate.className = text ? `plate-text ${team}` : "";
      setText(plate, text);
    }
  }

  // -- Statistics ------------------------------------------------------------------------------

  makeStatistics() {
    this.table = newElement("tbody");
    const table = newElement("table", "statistics", this.table);
    this.bar = newElement("i", "blue");
    const bar = newElement("div", "possession", this.bar, newElement("i", "yellow"));
    this.bars = bar;
    const header = newElement("header", "", newElement("h2", "", "Statistics"));
    const card = newElement("section", "card match-statistics", header, bar, table);
    document.querySelector(".panel").prepend(card, document.querySelector(".card.events"));
  }

  /** Fouls by kind: frames of blue and of yellow, in order. */
  countedFouls() {
    const counted = new Map(this.match.fouls.map((kind) => [kind, [[], []]]));
    for (const [frame, kind, , team] of this.replay.header.events) {
      const frames = counted.get(kind);
      if (!frames) continue;
      if (team !== "yellow") frames[0].push(frame);
      if (team !== "blue") frames[1].push(frame);
    }
    return new Map([...counted].filter(([, ofTeams]) => ofTeams.flat().length));
  }

  /** Fouls of both teams since the match began, by kinds that the replay has. */
  foulsAt(frame) {
    const { start } = this.replay.header.episodes[this.replay.episodeOf[frame]];
    const count = (frames) => frames.filter((at) => at >= start && at <= frame).length;
    return [...this.fouls].map(([kind, ofTeams]) => [kind, ofTeams.map(count)]);
  }

  /** Rows of the table: number of blue, name, number of yellow, and the class of the row. */
  statisticsAt(frame) {
    const steps = this.pair("possession_steps", frame);
    const touched = steps[0] + steps[1];
    const share = (part) => (touched ? `${Math.round((100 * part) / touched)}%` : "\u2013");
    const inPlay = this.number("in_play_steps", frame);
    const { start } = this.replay.header.episodes[this.replay.episodeOf[frame]];
    const played = Math.max(1, frame - start);
    const fouls = this.foulsAt(frame);
    const sum = (side) => fouls.reduce((total, [, counts]) => total + counts[side], 0);
    const row = (name, [blue, yellow], kind = "") => [String(blue), name, String(yellow), kind];
    return {
      share: touched ? steps[0] / touched : 0.5,
      rows: [
        row("possession", steps.map(share)),
        row("shots", this.pair("shots", frame)),
        row("passes", this.pair("passes", frame)),
        row("distance", this.pair("distance", frame).map((way) => `${Math.round(way)} m`)),
        ...(this.hasCards ? ["yellow", "red"] : []).map((color) =>
          row(`${color} cards`, this.pair(`${color}_cards`, frame))
        ),
        row("fouls", [sum(0), sum(1)]),
        ...fouls.map(([kind, counts]) => row(this.match.texts[kind].toLowerCase(), counts, "part")),
        [
          "",
          `ball in play ${clockText(inPlay * this.scene.timeStep)} (${Math.round((100 * inPlay) / played)}%)`,
          "",
          "all",
        ],
      ],
    };
  }

  showStatistics(frame) {
    const { share, rows } = this.statisticsAt(frame);
    this.bar.style.flexGrow = share.toFixed(3);
    this.bar.nextSibling.style.flexGrow = (1 - share).toFixed(3);
    while (this.table.rows.length < rows.length) {
      this.table.append(newElement("tr", "", newElement("td"), newElement("th"), newElement("td")));
    }
    [...this.table.rows].forEach((line, i) => {
      line.hidden = i >= rows.length;
      if (line.hidden) return;
      const [blue, name, yellow, kind] = rows[i];
      line.className = kind;
      [blue, name, yellow].forEach((text, column) => setText(line.cells[column], text));
    });
  }

  // -- Events ----------------------------------------------------------------------------------

  /** Events of the list, and the parts of the match; kicks, passes and touches on request. */
  listed(all) {
    const events = this.replay.header.events.filter(
      ([, kind]) => all || !this.match.details.includes(kind)
    );
    const stages = this.match.stages.map(([frame, text]) => [frame, "stage", "", text]);
    return [...events, ...stages].sort(([a], [b]) => a - b);
  }

  eventText(kind, robot, detail) {
    if (kind === "stage") return capital(detail);
    const text = this.match.texts[kind];
    const team = ["blue", "yellow"].includes(detail) ? detail : "";
    const who = robot ? robot.replace("_", " ") : team;
    if (kind === "out") return `${text}, ${detail.replace(/_/g, " ")}${robot ? `, ${who}` : ""}`;
    if (kind === "goal" && robot) {
      return `${text} for ${team}, ${robot.startsWith(team) ? "" : "off "}${who}`;
    }
    if (kind === "goal" || /card$/.test(kind)) return `${text} for ${team}`;
    if (kind === "end") return `${text}, ${detail}`;
    return who ? `${text}, ${who}` : text;
  }

  /** Give an entry of the list the look of its kind. */
  decorate(button, dot, kind, detail) {
    if (kind === "stage") button.classList.add("part-of-match");
    if (!this.match.prominent.includes(kind)) {
      if (["blue", "yellow"].includes(detail)) dot.className = detail;
      return;
    }
    button.classList.add("prominent", detail);
    if (/card$/.test(kind)) dot.className = `referee-card ${kind.replace("_", "-")}`;
  }

  /** Play and stops, parts of the match, fouls and cards: those of blue above the track. */
  drawOnTimeline(context, x, height) {
    const middle = height / 2;
    this.drawPlay(context, x, middle);
    this.drawStages(context, x, height);
    const { colors } = this.scene;
    for (const [frame, kind, , team] of this.replay.header.events) {
      const at = x(frame);
      if (this.match.fouls.includes(kind)) {
        for (const [side, y] of [["blue", middle - 10], ["yellow", middle + 5]]) {
          if (team && team !== side) continue;
          context.fillStyle = colors[side];
          context.fillRect(at - 1, y, 2, 5);
        }
      } else if (/card$/.test(kind)) {
        const top = team === "blue" ? middle - 23 : middle + 9;
        context.fillStyle = colors.ink;
        context.fillRect(at - 4.5, top, 9, 13);
        context.fillStyle = colors[kind.replace("_", "-")];
        context.fillRect(at - 3.5, top + 1, 7, 11);
      }
    }
  }

  /** The parts of the track in which the ball was in play are darker. */
  drawPlay(context, x, middle) {
    context.fillStyle = cssColor("--soft");
    context.globalAlpha = 0.4;
    let start = null;
    for (let frame = 0; frame <= this.replay.frames; frame++) {
      const inPlay = frame < this.replay.frames && this.number("in_play", frame) > 0;
      if (inPlay && start === null) start = frame;
      if (!inPlay && start !== null) {
        context.fillRect(x(start), middle - 4, x(frame - 1) - x(start), 8);
        start = null;
      }
    }
    context.globalAlpha = 1;
  }

  /** A line at the beginning of each part of the match, and its name under the track. */
  drawStages(context, x, height) {
    context.font = "10px system-ui, sans-serif";
    context.textBaseline = "bottom";
    context.fillStyle = cssColor("--soft");
    const end = x(this.replay.frames - 1);
    let free = 0; // right end of the last text
    for (const [frame, text] of this.match.stages) {
      context.fillRect(x(frame) - 0.5, 2, 1, height + LABEL_HEIGHT - 3);
      const { width } = context.measureText(text);
      const left = Math.max(Math.min(x(frame) + 5, end - width - 5), free);
      context.fillText(text, left, height + LABEL_HEIGHT - 1);
      free = left + width + 6;
    }
  }

  show(frame) {
    this.showBoard(frame);
    this.showTicker(frame);
    this.showStatistics(frame);
  }
}
