"""References: motions computed without any of the emitted code."""
