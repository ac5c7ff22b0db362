"""Pages that show a mechanism in motion: picture, player and simulator in one file that needs nothing else."""
