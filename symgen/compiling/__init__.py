"""From a mechanism to compiled code: the stages one after the other, in both shapes, and what they end in."""
