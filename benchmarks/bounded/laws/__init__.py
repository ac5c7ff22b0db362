"""Drawn problems of rows with bounds, as numbers: forces that obey all laws, by symgen and by other means."""
