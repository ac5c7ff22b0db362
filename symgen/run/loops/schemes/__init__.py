"""One step of each family of schemes, and the loops that are instances of the frame around it."""
