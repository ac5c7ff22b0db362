// -- the text: CodeMirror's editor, whose content is read and selected as a text field is ------------------------------------

const { Decoration, EditorState, EditorView, GutterMarker, RangeSetBuilder, StateEffect, StateField, StreamLanguage, Transaction } = CodeMirror;
const editor = data.editor, GROUPED = 600; // milliseconds within which typed characters are one step of undo
const changes = [], selections = []; // called after each change, with whether a hand is moving something; after the cursor has moved
let moving = false, bad = new Map(); // errors by line

// Lines with errors, and their numbers.
const errorsKnown = StateEffect.define();
class WrongNumber extends GutterMarker {
  elementClass = "bad";
}
const wrongNumber = new WrongNumber();
function onLines(state, lines, kind) {
  const made = new RangeSetBuilder();
  for (const [number, text] of [...lines].sort(([a], [b]) => a - b)) {
    if (number < 1 || number > state.doc.lines) continue; // of no line, or of one that has gone
    const { from } = state.doc.line(number);
    made.add(from, from, kind(text));
  }
  return made.finish();
}
const wrongLines = StateField.define({
  create: () => new Map(),
  update: (lines, { effects }) => effects.findLast((e) => e.is(errorsKnown))?.value ?? lines,
  provide: (field) => [
    EditorView.decorations.compute([field, "doc"], (state) => onLines(state, state.field(field), (title) => Decoration.line({ class: "bad", attributes: { title } }))),
    CodeMirror.gutterLineClass.compute([field, "doc"], (state) => onLines(state, state.field(field), () => wrongNumber)),
  ],
});
const mark = () => box.dispatch({ effects: errorsKnown.of(new Map(bad)) });

// TOML: comments, texts, headers, keys, numbers, words.
const PIECES = [
  [/^#.*/, "comment"],
  [/^(?:"(?:[^"\\]|\\.)*"?|'[^']*'?)/, "string"],
  [/^[A-Za-z_][\w-]*(?=\s*(?:=|\.[\w.-]+\s*=))/, "propertyName"],
  [/^[-+]?\d[\d_.]*(?:e[-+]?\d+)?/i, "number"],
  [/^(?:true|false)\b/, "number"],
  [/^[A-Za-z_][\w-]*/, null],
];
const HEADER = /^\[+\s*[A-Za-z_"'][^\]=#]*\]+/;
const toml = StreamLanguage.define({
  startState: () => ({ ends: "" }),
  token(stream, state) {
    if (state.ends) { // in a text of several lines
      if (stream.skipTo(state.ends)) {
        stream.match(state.ends);
        state.ends = "";
      } else stream.skipToEnd();
      return "string";
    }
    if (stream.eatSpace()) return null;
    const long = stream.match(/^(?:"""|''')/);
    if (long) {
      [state.ends] = long;
      return "string";
    }
    if (stream.column() === stream.indentation() && stream.match(HEADER)) return "heading";
    const piece = PIECES.find(([pattern]) => stream.match(pattern));
    if (!piece) stream.next();
    return piece ? piece[1] : null;
  },
  languageData: { commentTokens: { line: "#" }, closeBrackets: { brackets: [] } },
});
const { tags } = CodeMirror, looks = CodeMirror.HighlightStyle.define([
  { tag: tags.heading, color: "var(--key)", fontWeight: "bold" }, { tag: tags.propertyName, color: "var(--key)" },
  { tag: tags.string, color: "var(--word)" }, { tag: tags.number, color: "var(--count)" }, { tag: tags.comment, color: "var(--soft)" },
]);

// A table folds at its header.
const tables = CodeMirror.foldService.of((state, start, end) => {
  if (!/^\s*\[/.test(state.sliceDoc(start, end))) return null;
  let last = state.doc.lineAt(start).number;
  while (last < state.doc.lines && !/^\s*\[+[A-Za-z_"']/.test(state.doc.line(last + 1).text)) last++;
  while (!state.doc.line(last).text.trim()) last--;
  return state.doc.line(last).to > end ? { from: end, to: state.doc.line(last).to } : null;
});

const EXTENSIONS = [
  CodeMirror.lineNumbers(), CodeMirror.foldGutter(), tables, wrongLines, toml, CodeMirror.syntaxHighlighting(looks), CodeMirror.bracketMatching(),
  CodeMirror.history({ newGroupDelay: GROUPED }), CodeMirror.search({ top: true }), CodeMirror.drawSelection(), EditorState.allowMultipleSelections.of(true),
  CodeMirror.autocompletion({ override: [completions], icons: false, interactionDelay: 0, activateOnTypingDelay: 0 }),
  CodeMirror.keymap.of([{ key: "Tab", run: CodeMirror.acceptCompletion }, ...CodeMirror.searchKeymap, ...CodeMirror.foldKeymap, ...CodeMirror.defaultKeymap]),
  EditorView.cspNonce.of(document.querySelector("script[nonce]").nonce),
  EditorView.contentAttributes.of({ id: "text", "aria-label": "Text of the mechanism file", "aria-describedby": "about status" }),
  EditorView.updateListener.of(({ docChanged, selectionSet, startState, state }) => {
    if (docChanged) for (const each of changes) each(moving);
    if (docChanged || selectionSet) for (const each of selections) each();
    if (docChanged || selectionSet || CodeMirror.selectedCompletion(state) !== CodeMirror.selectedCompletion(startState)) about();
  }),
];
const box = new EditorView({ parent: $("paper"), extensions: EXTENSIONS });
box.scrollDOM.tabIndex = 0; // scrolled by keys
$("paper").addEventListener("keydown", (e) => e.stopPropagation()); // the player's keys are letters here
let known = [null, ""]; // the last document, and its text
const T = Object.defineProperties(box.contentDOM, {
  value: {
    get: () => {
      if (known[0] !== box.state.doc) known = [box.state.doc, box.state.doc.toString()];
      return known[1];
    },
    set: (text) => replaceText(text, { annotations: Transaction.addToHistory.of(false) }),
  },
  selectionStart: { get: () => box.state.selection.main.from },
  selectionEnd: { get: () => box.state.selection.main.to },
  setSelectionRange: { value: (anchor, head = anchor) => box.dispatch({ selection: { anchor, head } }) },
});

// Put a text in, of which what is alike at both ends stays.
function replaceText(text, further) {
  const old = T.value, shorter = Math.min(old.length, text.length);
  let head = 0, tail = 0;
  while (head < shorter && old[head] === text[head]) head++;
  while (tail < shorter - head && old[old.length - 1 - tail] === text[text.length - 1 - tail]) tail++;
  box.dispatch({ changes: { from: head, to: old.length - tail, insert: text.slice(head, text.length - tail) }, ...further });
}

// Another text, as one step of undo; the cursor goes to a place.
function setText(text, from = null, to = from) {
  if (text === T.value) return;
  const anchor = from ?? Math.min(T.selectionStart, text.length);
  replaceText(text, { selection: { anchor, head: to ?? anchor }, annotations: CodeMirror.isolateHistory.of("full") });
}

// A text that is still being dragged about: no step of undo.
function preview(text) {
  moving = true;
  if (T.value !== text) T.value = text;
  moving = false;
}

// Begin with a text: nothing can be undone.
function beginText(text) {
  box.setState(EditorState.create({ doc: text, extensions: EXTENSIONS }));
  for (const each of changes) each(false);
}

const undo = () => CodeMirror.undo(box), redo = () => CodeMirror.redo(box), seek = () => CodeMirror.openSearchPanel(box);
const lineAt = (place) => box.state.doc.lineAt(place).number;
const startOfLine = (line) => (line > box.state.doc.lines ? T.value.length + 1 : box.state.doc.line(line).from);

function select(anchor, head = anchor, focus = true) {
  if (focus) box.focus();
  // on a telephone the text lies below the picture: what a hand draws there must not scroll it away
  const stays = !focus && matchMedia("(max-width: 760px)").matches;
  box.dispatch({ selection: { anchor, head }, effects: stays ? [] : EditorView.scrollIntoView(anchor, { y: "nearest", yMargin: 60 }) });
}
$("seek").addEventListener("click", seek);
