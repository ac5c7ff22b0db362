"""Runs that follow another one: with finer steps to estimate its error, with other settings where it failed."""
