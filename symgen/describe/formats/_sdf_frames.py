"""Frames of an SDF file: poses in chains of frames, and the links that frames move with."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Collection
from dataclasses import dataclass

from symgen.base.errors import InputError, quote, suggest
from symgen.describe.formats._poses import Pose
from symgen.describe.formats._robot import GROUND
from symgen.describe.formats._xml import pose_of_text

MODEL, WORLD = "__model__", "world"


@dataclass(frozen=True)
class PlacedFrame:
    """A frame of the file: the frame that its pose is in, and the link or frame that it moves with."""

    base: str
    pose: Pose
    attached: str


class SdfFrames:
    """The frames of a file.

    Parameters
    ----------
    source : str
        The file, with which every message begins.
    links : collection of str
        Names of its links.
    """

    def __init__(self, source: str, links: Collection[str]) -> None:
        self.source, self.links = source, links
        self.placed = {WORLD: PlacedFrame("", Pose(), WORLD)}
        self.places = {WORLD: Pose()}

    def add_frame(self, name: str, placed: PlacedFrame, where: str) -> None:
        """Note a frame."""
        if name in self.placed:
            raise InputError(where, "a name used once", f"{quote(name)} twice")
        self.placed[name] = placed

    def add_element(
        self, element: ET.Element, name: str, prefix: str, otherwise: str, attached: str, where: str
    ) -> None:
        """Note the frame of an element, whose pose is in a frame that it names, or `otherwise`."""
        self.add_frame(
            name, PlacedFrame(self.base_of_pose(element, prefix, otherwise), self.pose(element), attached), where
        )

    def base_of_pose(self, element: ET.Element, prefix: str, otherwise: str) -> str:
        """Return the frame that the pose of an element is in."""
        pose = element.find("pose")
        name = "" if pose is None else pose.get("relative_to", pose.get("frame", ""))
        return prefix + name if name else otherwise

    def pose(self, element: ET.Element, where: str = "", base: str = "") -> Pose:
        """Return the pose of an element; at the top of a file it has no other base."""
        pose = element.find("pose")
        if pose is None:
            return Pose()
        where = f"{self.source}: pose of {quote(element.get('name', element.tag))}"
        if base == WORLD and pose.get("relative_to", WORLD) != WORLD:
            raise InputError(where, "a pose in the world", quote(pose.get("relative_to", "")))
        return pose_of_text(where, pose)

    def resolve_name(self, name: str, where: str) -> str:
        """Return the name of a frame; a model is its own frame."""
        if name not in self.placed and f"{name}::{MODEL}" in self.placed:
            name = f"{name}::{MODEL}"
        if name not in self.placed:
            raise InputError(where, "the name of a frame", quote(name), suggest(name, self.placed))
        return name

    def place(self, name: str) -> Pose:
        """Return the place of a frame in the ground frame."""
        chain, at = list[str](), name
        while at not in self.places:
            if at in chain:
                raise InputError(f"{self.source}: frame {quote(at)}", "poses in chains", "a ring of them")
            chain.append(at)
            at = self.resolve_name(self.placed[at].base, f"{self.source}: pose of {quote(at)}, relative_to")
        for at in reversed(chain):
            base = self.resolve_name(self.placed[at].base, self.source)
            self.places[at] = self.places[base] @ self.placed[at].pose
        return self.places[name]

    def link_of(self, name: str, where: str) -> str:
        """Return the link that a frame moves with; empty for the ground."""
        passed, at = set[str](), self.resolve_name(name, where)
        while at not in self.links:
            if at == WORLD:
                return GROUND
            if at in passed or not self.placed[at].attached:
                raise InputError(where, "a frame that a link carries", quote(name))
            passed.add(at)
            at = self.resolve_name(self.placed[at].attached, where)
        return at
