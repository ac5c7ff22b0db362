// The pair of brackets at the cursor, outside of texts and comments.
const PAIRS = { "(": ")", "[": "]", "{": "}" }, CLOSING = new Set(Object.values(PAIRS));

// The brackets of a text, each as its place and the place of its partner, or -1 where it has none.
function bracketsOf(text) {
  const partner = new Map(), open = [];
  for (let i = 0; i < text.length; i++) {
    const c = text[i];
    if (c === "#") {
      const end = text.indexOf("\n", i);
      i = end < 0 ? text.length : end;
    } else if (c === '"' || c === "'") {
      const long = text.startsWith(c.repeat(3), i), end = text.slice(i + (long ? 3 : 1)).search(long ? c.repeat(3) : new RegExp(`${c}|\\n`));
      // formulas are texts with brackets of their own: those pair within the text
      const last = end < 0 ? text.length : i + (long ? 3 : 1) + end;
      if (!long) pairsWithin(text, i + 1, last, partner);
      i = last + (long ? 2 : 0);
    } else if (PAIRS[c]) open.push(i);
    else if (CLOSING.has(c)) pair(text, open, i, partner);
  }
  for (const i of open) partner.set(i, -1);
  return partner;
}

function pair(text, open, i, partner) {
  const from = open.length && PAIRS[text[open.at(-1)]] === text[i] ? open.pop() : -1;
  partner.set(i, from);
  if (from >= 0) partner.set(from, i);
}

function pairsWithin(text, from, to, partner) {
  const open = [];
  for (let i = from; i < to; i++) {
    if (PAIRS[text[i]]) open.push(i);
    else if (CLOSING.has(text[i])) pair(text, open, i, partner);
  }
  for (const i of open) partner.set(i, -1);
}

function markBrackets() {
  for (const each of document.querySelectorAll("#area .bracket")) each.remove();
  if (document.activeElement !== T || T.selectionStart !== T.selectionEnd || T.value.length > LARGE) return;
  const at = [T.selectionStart - 1, T.selectionStart].find((i) => PAIRS[T.value[i]] || CLOSING.has(T.value[i]));
  if (at === undefined) return;
  const partner = bracketsOf(T.value).get(at);
  if (partner === undefined) return;
  for (const place of [at, partner].filter((i) => i >= 0)) {
    const line = lineAt(place), column = place - startOfLine(line), box = element("span", "", partner < 0 ? "bracket bad" : "bracket");
    box.style.left = `${8 + column * characterWidth()}px`;
    box.style.top = `${TOP + (line - 1) * LINE}px`;
    box.style.width = `${characterWidth()}px`;
    box.setAttribute("aria-hidden", "true");
    $("area").insertBefore(box, T);
  }
}
document.addEventListener("selectionchange", markBrackets);
T.addEventListener("blur", markBrackets);
T.addEventListener("focus", markBrackets);
