"""The editor: a page with the text of a mechanism file beside its picture and motion, served to this computer alone."""
