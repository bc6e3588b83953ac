# What a submission in Python finds without an import, for editors: Pyright reads it, and VS Code with it. It is never run.
from kinemark import plot as plot, quintic as quintic, quintic_rate as quintic_rate
