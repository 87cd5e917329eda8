// The referee in words.

const KICKS = {
  PREPARE_KICKOFF: "kick-off",
  PREPARE_PENALTY: "penalty kick",
  DIRECT_FREE: "free kick",
  GOAL_KICK: "goal kick",
  FREE_BALL: "free ball",
  FORCE_START: "start",
  NORMAL_START: "start",
};

const STAGES = {
  NORMAL_FIRST_HALF_PRE: "1st half",
  NORMAL_FIRST_HALF: "1st half",
  NORMAL_HALF_TIME: "half time",
  NORMAL_SECOND_HALF_PRE: "2nd half",
  NORMAL_SECOND_HALF: "2nd half",
  POST_GAME: "end",
};

/** Team in the name of a command, or "". */
function sideOf(command) {
  return /_(BLUE|YELLOW)$/.exec(command ?? "")?.[1].toLowerCase() ?? "";
}

function kickText(command) {
  const side = sideOf(command);
  const text = KICKS[(command ?? "").replace(/_(BLUE|YELLOW)$/, "")] ?? "start";
  return side ? `${text} ${capital(side)}` : text;
}

function capital(text) {
  return text.charAt(0).toUpperCase() + text.slice(1);
}

/** Command of the referee; no text while the ball is in play. */
function commandText(told) {
  const { command, kick, next } = told;
  if (told.stage === "POST_GAME") {
    const [blue, yellow] = told.score;
    if (blue === yellow) return "End of the match: a draw";
    return `End of the match: ${blue > yellow ? "Blue" : "Yellow"} wins`;
  }
  if (command === "HALT" || command === "STOP") {
    const name = capital(command.toLowerCase());
    return next ? `${name}: ${kickText(next)} next` : name;
  }
  if (command.startsWith("BALL_PLACEMENT")) return `Ball placement ${capital(sideOf(command))}`;
  if (command.startsWith("PREPARE")) return `Prepare ${kickText(command)}`;
  if (told.in_play) return "";
  return capital(kickText(command === "NORMAL_START" ? kick : command));
}

function stageText(told) {
  return STAGES[told.stage] ?? told.stage.toLowerCase().replaceAll("_", " ");
}

/** An event, such as "Ball left field goal line". */
function eventText({ kind, team, robot }, blue) {
  const words = capital(kind.toLowerCase().replaceAll("_", " ").replace(/\bbot\b/g, "robot"));
  if (robot !== null) return `${words}: ${robot < blue ? `blue ${robot}` : `yellow ${robot - blue}`}`;
  return team === null ? words : `${words}: ${["blue", "yellow"][team]}`;
}
