"""The looped shape: one kernel for each kind and specialisation, tables of indices, and formulas on whole vectors."""
