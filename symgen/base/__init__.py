"""What every room may need: errors, checks of arguments, settings, kinds by file name, files.

In: values and names as users write them.
Out: checked values, one form of errors, kinds of a folder.
Imports: Babel when needed; nothing else.
"""
