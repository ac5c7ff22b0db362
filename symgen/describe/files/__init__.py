"""Files of mechanisms: TOML or a builder's keys in, a validated `Mechanism` or every problem with its line out.

In: the text of a file, a catalogue entry or the keys of a builder.
Out: a validated `Mechanism`; the schema, templates and origins of its values.
Imports: msgspec; `parts`, `bounds`, `beams`; `forces`, `joints` by name.
"""
