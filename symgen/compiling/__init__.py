"""From a mechanism to compiled code: the stages in order, in both shapes, and the compiled models."""
