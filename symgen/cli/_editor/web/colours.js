// Colours of a line of TOML: headers and keys, texts, numbers, comments.
const PIECE = /(#.*)|("(?:[^"\\]|\\.)*"?|'[^']*'?)|([A-Za-z_][\w-]*)(?=\s*(?:=|\.[\w.-]+\s*=))|([-+]?\b\d[\d_.]*(?:e[-+]?\d+)?\b)|(true|false)\b/gi;

function colouredLine(text, plain) {
  const line = element("div");
  if (plain || !text) {
    line.textContent = text;
    return line;
  }
  const header = /^\s*\[[^=#]*\]+/.exec(text);
  let at = 0;
  if (header) {
    line.append(element("b", header[0]));
    at = header[0].length;
  }
  PIECE.lastIndex = at;
  for (let piece = PIECE.exec(text); piece; piece = PIECE.exec(text)) {
    if (piece.index > at) line.append(text.slice(at, piece.index));
    const tag = ["i", "u", "b", "s", "s"][[1, 2, 3, 4, 5].findIndex((k) => piece[k] !== undefined)];
    line.append(element(tag, piece[0]));
    at = piece.index + piece[0].length;
  }
  if (at < text.length) line.append(text.slice(at));
  return line;
}
