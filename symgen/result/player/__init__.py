"""Pages with motion: a motion, its scene and the emitted code in one page that works offline.

In: a motion and its mechanism.
Out: a page, or pictures and films.
Imports: NumPy; matplotlib and Pillow for films; `planning` and rooms below.
"""
