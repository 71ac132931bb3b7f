"""Basilisk's special effectors in place of the general chain of hinges that an emitted script uses.

A hinge alone can be a HingedRigidBody, and a row of equal ones an NHingedRigidBody. They fly the same
motion and cost less, so a race has to know them.
"""

from __future__ import annotations

import numpy as np
from Basilisk.simulation import hingedRigidBodyStateEffector, nHingedRigidBodyStateEffector



def tensor_of(link: dict) -> np.ndarray:
    return np.array(link["ISPntSc_S"], float)


def frame_of(link: dict) -> np.ndarray | None:
    """Rows outboard, axis and normal, in the link's axes; None where no panel lies so."""
    outboard = np.array(link["R_ScS_S"], float)
    length = np.linalg.norm(outboard)
    if length == 0:
        return None
    axis = np.array(link["SHat_S"], float)
    rows = np.array([outboard / length, axis, np.cross(outboard / length, axis)])
    tensor = rows @ tensor_of(link) @ rows.T
    is_right = abs(rows[0] @ axis) < 1e-12
    is_diagonal = np.abs(tensor - np.diag(np.diag(tensor))).max() <= 1e-12 * np.abs(tensor).max()
    return rows if is_right and is_diagonal else None


def is_row(links: list[dict]) -> bool:
    """Of equal panels, each hinged at the end of the one before."""
    frame = frame_of(links[0])
    if frame is None:
        return False
    end = 2 * np.array(links[0]["R_ScS_S"], float)
    same = ("Mass", "SHat_S", "R_ScS_S", "ISPntSc_S")
    return all(
        np.allclose(link["R_SP_P"], end, rtol=0, atol=1e-12)
        and np.allclose(link["DCM_S0P"], np.eye(3), rtol=0, atol=1e-15)
        and all(np.allclose(link[key], links[0][key], rtol=1e-12, atol=0) for key in same)
        for link in links[1:]
    )


def can_be_special(module: dict) -> bool:
    """Whether every chain of the script can: none is driven, loaded or at rest off its zero."""
    chains = module.get("HINGES", {})
    inputs = {name for _, changes in module["INPUTS"] for name in changes}
    loaded = {place["on"][0] for place in module.get("LOADS", {}).values() if place["on"]}
    names = {link for links in chains.values() for link in links}
    free = not any(name.split(".torque")[0] in names for name in inputs if name.endswith(".torque"))
    free = free and not loaded & chains.keys() and not module.get("RESTS")
    return bool(chains) and free and all(is_row(list(links.values())) for links in chains.values())


def special_name(module: dict) -> str:
    if not can_be_special(module):
        return ""
    sizes = {len(links) > 1 for links in module["HINGES"].values()}
    return ", ".join("NHingedRigidBody" if several else "HingedRigidBody" for several in sorted(sizes))


def special_vehicle(module: dict):
    """The BSM half of a script, with its chains of hinges made of special effectors."""
    chains = module["HINGES"]
    kept = dict(chains)
    chains.clear()
    try:
        vehicle = module["Vehicle"]("bsm")
    finally:
        chains.update(kept)
    for name, links in kept.items():
        effector = single(links) if len(links) == 1 else several(links)
        effector.nameOfThetaState, effector.nameOfThetaDotState = name, name + ".rate"
        vehicle.body.addStateEffector(effector)
        vehicle.modules.insert(0, effector)
        for row, link in enumerate(links):
            vehicle.states |= {link + ".position": (name, row), link + ".rate": (name + ".rate", row)}
    return vehicle


def panel_values(link: dict) -> tuple[np.ndarray, list, float]:
    """dcm from the parent to the panel's axes (inboard, axis, the third), tensor and distance d."""
    frame = frame_of(link)
    rows = np.diag([-1.0, 1.0, -1.0]) @ frame
    tensor = rows @ tensor_of(link) @ rows.T
    distance = float(np.linalg.norm(link["R_ScS_S"]))
    return rows @ np.array(link["DCM_S0P"], float), tensor.tolist(), distance


def single(links: dict):
    (link,) = links.values()
    effector = hingedRigidBodyStateEffector.HingedRigidBodyStateEffector()
    dcm, tensor, distance = panel_values(link)
    effector.mass, effector.d, effector.IPntS_S = link["Mass"], distance, tensor
    effector.k, effector.c = link.get("K", 0), link.get("C", 0)
    effector.r_HB_B, effector.dcm_HB = [[x] for x in link["R_SP_P"]], dcm.tolist()
    return effector


def several(links: dict):
    effector = nHingedRigidBodyStateEffector.NHingedRigidBodyStateEffector()
    first = next(iter(links.values()))
    effector.r_HB_B, effector.dcm_HB = [[x] for x in first["R_SP_P"]], panel_values(first)[0].tolist()
    for link in links.values():
        panel = nHingedRigidBodyStateEffector.HingedPanel()
        _, panel.IPntS_S, panel.d = panel_values(link)
        panel.mass, panel.k, panel.c = link["Mass"], link.get("K", 0), link.get("C", 0)
        effector.addHingedPanel(panel)
    return effector
