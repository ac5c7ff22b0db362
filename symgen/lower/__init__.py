"""From equations to programs: patterns, factorisations, laws, hoisted numbers."""
