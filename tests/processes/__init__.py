"""What users start as processes, as pages say: programs of this environment, each in a process of its own."""
