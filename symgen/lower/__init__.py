"""From equations to programs: patterns, factorisations, laws, what is hoisted."""
