// -- words from the schema ------------------------------------------------------------------------------------------------

const { sections, units } = editor.words;
let choices = [], chosen = 0, typedWord = "";

const unquoted = (part) => part.trim().replace(/^["']|["']$/g, "");
const entriesOf = (text, section) => [...text.matchAll(new RegExp(`^\\s*\\[${section}\\.([\\w-]+)\\]`, "gm"))].map((m) => m[1]);

// Keys of a table whose entries are its lines, such as parameters.
function keysOf(text, section) {
  const block = new RegExp(`^\\s*\\[${section}\\]([^]*?)(?=^\\s*\\[|$(?![^]))`, "m").exec(text);
  return block ? [...block[1].matchAll(/^\s*([A-Za-z]\w*)\s*=/gm)].map((m) => m[1]) : [];
}

function pointsOf(text, body) {
  const block = new RegExp(`^\\s*\\[bodies\\.${body}\\]([^]*?)(?=^\\s*\\[|$(?![^]))`, "m").exec(text);
  const table = block && /points\s*=\s*\{([^}]*)\}/.exec(block[1]);
  return table ? [...table[1].matchAll(/([A-Za-z]\w*)\s*=/g)].map((m) => m[1]) : [];
}

// Where the cursor is: table, key, whether in a value and in a text, and the word before it.
function context(place = T.selectionStart) {
  const text = T.value, start = text.lastIndexOf("\n", place - 1) + 1, line = text.slice(start, place);
  const headers = [...text.slice(0, start).matchAll(/^\s*\[+([^\]\n#]+)\]+/gm)], table = headers.length ? headers.at(-1)[1].split(".").map(unquoted) : [];
  const begin = headers.length ? headers.at(-1).index : 0, after = text.slice(start).search(/^\s*\[(?!\[?[-\d"'\s])[A-Za-z]/m);
  const block = text.slice(begin, after < 0 ? text.length : start + Math.max(after, line.length));
  const type = /^\s*type\s*=\s*"([\w-]+)"/m.exec(block)?.[1], quotes = (line.match(/"/g) || []).length;
  const inner = /\{[^}]*$/.test(line) && quotes % 2 === 0 ? line.slice(line.lastIndexOf("{") + 1).split(",").pop() : line;
  const key = /^\s*["']?([\w.-]+)["']?\s*=/.exec(inner)?.[1] ?? /([\w-]+)\s*=[^=]*$/.exec(line)?.[1];
  const inValue = /^\s*["']?[\w.-]+["']?\s*=/.test(inner);
  return { text, line, table, block, type, key, inValue, inText: quotes % 2 === 1, header: /^\s*\[+[\w.-]*$/.test(line), comment: /^[^"']*#/.test(line), word: /[\w-]*$/.exec(line)[0] };
}

const named = (names) => [...new Set(names)].map((name) => [name, ""]);

// Words that may stand at the cursor, each with its sentence.
function offered(c) {
  if (c.comment) return [];
  if (c.header) return c.line.includes(".") ? [] : Object.keys(sections).map((name) => [name, sections[name].named ? "named entries" : "a table"]);
  const section = sections[c.table[0]];
  if (!section) return [];
  if (!c.inValue) {
    if (c.inText) return [];
    if (section.types) return Object.entries(section.types[c.type]?.keys || { type: "which kind it is", ...Object.assign({}, ...Object.values(section.types).map((kind) => kind.keys)) });
    if (section.named && c.table.length < 2 && !/\{/.test(c.line)) return [];
    return c.table.length > 2 ? [] : Object.entries(section.keys);
  }
  if (!c.inText) return [];
  if (c.key === "type") return section.types ? Object.entries(section.types).map(([name, kind]) => [name, kind.text]) : named(["rigid", "point"]);
  if (["between", "body", "reaction"].includes(c.key)) return named(["ground", ...entriesOf(c.text, "bodies")]);
  if (c.key === "joint") return named(entriesOf(c.text, "joints"));
  if (c.key === "unit") return named(units);
  if (c.key === "at" && !/\[\s*\[?[^\]]*,?[^\]]*"[^"]*[-+*/][^"]*$/.test(c.line)) {
    const bodies = /between\s*=\s*\[([^\]]*)\]/.exec(c.block)?.[1].split(",").map(unquoted) || [/body\s*=\s*"([^"]*)"/.exec(c.block)?.[1]];
    return named(["centre", "origin", ...bodies.flatMap((body) => (body ? pointsOf(c.text, body) : []))]);
  }
  return named([...keysOf(c.text, "parameters"), ...keysOf(c.text, "inputs"), ...entriesOf(c.text, "bodies")]);
}

function complete(asked = false) {
  const c = context();
  typedWord = c.word;
  choices = T.selectionStart !== T.selectionEnd || (!c.word && !asked && !(c.inText && ["type", "between", "body", "joint"].includes(c.key))) ? [] : offered(c);
  choices = choices.filter(([name]) => name.startsWith(c.word) && (asked || name !== c.word)).slice(0, 60);
  chosen = 0;
  list();
}

function list() {
  const box = $("choices");
  box.textContent = "";
  box.hidden = !choices.length;
  T.removeAttribute("aria-activedescendant");
  if (!choices.length) return;
  choices.forEach(([name, text], i) => {
    const item = element("li", name);
    item.id = `choice${i}`;
    item.setAttribute("role", "option");
    item.setAttribute("aria-selected", i === chosen);
    item.append(element("span", text));
    item.addEventListener("pointerdown", (e) => {
      e.preventDefault();
      take(i);
    });
    box.append(item);
  });
  T.setAttribute("aria-activedescendant", `choice${chosen}`);
  const line = lineAt(T.selectionStart), column = T.selectionStart - startOfLine(line) - typedWord.length;
  box.style.left = `${8 + column * characterWidth()}px`;
  box.style.top = `${TOP + line * LINE}px`;
  box.children[chosen].scrollIntoView({ block: "nearest" });
  about();
}

let wide = 0;
function characterWidth() {
  if (!wide) {
    const probe = element("span", "0".repeat(100));
    $("paint").append(probe);
    wide = probe.getBoundingClientRect().width / 100;
    probe.remove();
  }
  return wide;
}

function take(i) {
  const [name] = choices[i], at = T.selectionStart, from = at - typedWord.length;
  choices = [];
  list();
  setText(T.value.slice(0, from) + name + T.value.slice(at), from + name.length);
}

// The sentence of the key that the cursor is at, or of the word that is chosen.
function about() {
  let text = choices[chosen]?.[1] || "";
  if (!choices.length) {
    const place = T.value.indexOf("\n", T.selectionStart), c = context(place < 0 ? T.value.length : place), section = sections[c.table[0]];
    const here = context(), key = here.inValue ? here.key : c.key;
    const keys = section && (section.types ? section.types[c.type]?.keys : section.keys);
    if (keys && Object.hasOwn(keys, key)) text = key === "type" && section.types?.[c.type] ? `${c.type}: ${section.types[c.type].text}` : `${key}: ${keys[key]}`;
  }
  $("about").textContent = text;
}

T.addEventListener("input", () => complete());
T.addEventListener("blur", () => {
  choices = [];
  list();
});
document.addEventListener("selectionchange", () => document.activeElement === T && !choices.length && about());
T.addEventListener("keydown", (e) => {
  if (e.key === " " && e.ctrlKey) {
    e.preventDefault();
    complete(true);
  }
  if (!choices.length) return;
  const act = { ArrowDown: () => (chosen = (chosen + 1) % choices.length), ArrowUp: () => (chosen = (chosen + choices.length - 1) % choices.length), Enter: () => take(chosen), Tab: () => take(chosen), Escape: () => (choices = []) }[e.key];
  if (!act) {
    if (["ArrowLeft", "ArrowRight", "Home", "End"].includes(e.key)) choices = [];
    if (!choices.length) list();
    return;
  }
  e.preventDefault();
  e.stopPropagation();
  act();
  if (choices.length || !$("choices").hidden) list();
});
