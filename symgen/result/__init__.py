"""Results of runs: labelled arrays, status, files and plots."""
