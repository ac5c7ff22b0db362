"""What a run gave: labelled arrays, status, files and plots."""
