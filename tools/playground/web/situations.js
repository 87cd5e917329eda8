// A situation as the end of an address.

function toBase64(bytes) {
  let text = "";
  for (const byte of bytes) text += String.fromCharCode(byte);
  return btoa(text).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
}

function fromBase64(text) {
  const plain = atob(text.replaceAll("-", "+").replaceAll("_", "/"));
  return Uint8Array.from(plain, (letter) => letter.charCodeAt(0));
}

/** A text that a page can be opened with: choices as JSON, numbers as base64. */
function situationText(choices, numbers) {
  const bytes = new Uint8Array(numbers.buffer, numbers.byteOffset, numbers.byteLength);
  return `#${toBase64(new TextEncoder().encode(JSON.stringify(choices)))}.${toBase64(bytes)}`;
}

/** Choices and numbers of such a text; null for another one. */
function readSituation(text) {
  const parts = /^#([\w-]+)\.([\w-]*)$/.exec(text);
  if (!parts) return null;
  try {
    const choices = JSON.parse(new TextDecoder().decode(fromBase64(parts[1])));
    return { choices, numbers: new Float32Array(fromBase64(parts[2]).buffer) };
  } catch {
    return null;
  }
}

/** Choices of a page that is opened without a link. */
function defaultChoices(leagues) {
  return { league: leagues[0].id, sides: [null, null], skills: [1, 0.7], seed: 1, conditions: {} };
}

/** Choices of a link with defaults in place of wrong values, and a text for each of these. */
function checkedChoices(given, leagues) {
  const choices = defaultChoices(leagues);
  const wrong = [];
  const take = (name, value, valid, set) => {
    if (value === undefined || value === null) return;
    if (valid(value)) set(value);
    else wrong.push(`${name} cannot be ${JSON.stringify(value).slice(0, 60)}`);
  };
  const within = (low, high) => (value) => Number.isFinite(value) && value >= low && value <= high;
  const known = Object(given);
  take("league", known.league, (id) => leagues.some((league) => league.id === id), (id) => (choices.league = id));
  const league = leagues.find(({ id }) => id === choices.league);
  const sides = [...(league.scripted ? ["scripted"] : []), ...league.policies.map(({ id }) => id), "idle"];
  for (const [team, name] of ["blue", "yellow"].entries()) {
    take(name, known.sides?.[team], (side) => sides.includes(side), (side) => (choices.sides[team] = side));
    take(`skill of ${name}`, known.skills?.[team], within(0, 1), (skill) => (choices.skills[team] = skill));
  }
  const isSeed = (seed) => Number.isInteger(seed) && within(0, 2 ** 32 - 1)(seed);
  take("seed", known.seed, isSeed, (seed) => (choices.seed = seed));
  for (const [id, value] of Object.entries(Object(known.conditions))) {
    const slider = SLIDERS.find((one) => one.id === id);
    const valid = slider ? within(slider.low, slider.high) : () => false;
    take(slider?.name.toLowerCase() ?? `condition ${id.slice(0, 20)}`, value, valid, () => (choices.conditions[id] = value));
  }
  return { choices, wrong };
}
