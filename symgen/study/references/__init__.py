"""References: motions by routes that share nothing with the emitted code."""
