// -- words from the schema ------------------------------------------------------------------------------------------------

const { sections, units } = editor.words;

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

// What CodeMirror offers at a place.
function completions({ pos, explicit }) {
  const c = context(pos);
  if (!c.word && !explicit && !(c.inText && ["type", "between", "body", "joint"].includes(c.key))) return null;
  const options = offered(c).filter(([name]) => explicit || name !== c.word).map(([label, detail]) => ({ label, detail }));
  return options.length ? { from: pos - c.word.length, options, validFor: /^[\w-]*$/ } : null;
}

// The sentence of the key that the cursor is at, or of the word that is chosen.
function about() {
  let text = CodeMirror.selectedCompletion(box.state)?.detail ?? "";
  if (!text) {
    const place = T.value.indexOf("\n", T.selectionStart), c = context(place < 0 ? T.value.length : place), section = sections[c.table[0]];
    const here = context(), key = here.inValue ? here.key : c.key;
    const keys = section && (section.types ? section.types[c.type]?.keys : section.keys);
    if (keys && Object.hasOwn(keys, key)) text = key === "type" && section.types?.[c.type] ? `${c.type}: ${section.types[c.type].text}` : `${key}: ${keys[key]}`;
  }
  $("about").textContent = text;
}
