"""From settings to a run that is ready, for bodies and for trees of joints alike; `prepare.py` lists the steps."""
