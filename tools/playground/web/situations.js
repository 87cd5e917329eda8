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
