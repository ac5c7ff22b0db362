// What the text pane takes from CodeMirror 6; `make codemirror` bundles it into codemirror.js.
export { EditorState, RangeSetBuilder, StateEffect, StateField, Transaction } from "@codemirror/state";
export { Decoration, EditorView, GutterMarker, drawSelection, gutterLineClass, highlightActiveLineGutter, keymap, lineNumbers } from "@codemirror/view";
export { defaultKeymap, history, isolateHistory, redo, redoDepth, undo, undoDepth } from "@codemirror/commands";
export { acceptCompletion, autocompletion, selectedCompletion } from "@codemirror/autocomplete";
export { openSearchPanel, search, searchKeymap } from "@codemirror/search";
export { HighlightStyle, StreamLanguage, bracketMatching, codeFolding, foldGutter, foldKeymap, foldService, syntaxHighlighting } from "@codemirror/language";
export { tags } from "@lezer/highlight";
