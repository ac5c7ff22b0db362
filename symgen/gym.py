"""Environments of Gymnasium, of one run and of many: `make` and `make_vec`."""

from symgen.study.gym import make, make_vec

__all__ = ["make", "make_vec"]
