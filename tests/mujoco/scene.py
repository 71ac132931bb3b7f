"""scene.py MJCF STEPS STEP_S: fly an MJCF from its keyframe in Basilisk's MJScene and print the last
qpos as JSON. A process of its own, for a fault in there ends the interpreter."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import mujoco
import numpy as np
from Basilisk.architecture import messaging
from Basilisk.simulation import mujoco as basilisk_mujoco
from Basilisk.simulation import svIntegrators


def main(file: str, steps: int, step_ns: int) -> None:
    key = mujoco.MjModel.from_xml_path(file)
    scene = basilisk_mujoco.MJScene(Path(file).read_text())
    scene.highOrderAttitudeIntegration = True
    kept = [svIntegrators.svIntegratorRK4(scene)]  # C++ holds raw pointers alone
    scene.setIntegrator(kept[0])
    for i in range(key.nu):
        torque = messaging.SingleActuatorMsgPayload()
        torque.input = key.key_ctrl[0][i]
        kept.append(messaging.SingleActuatorMsg().write(torque))
        scene.getSingleActuator(key.actuator(i).name).actuatorInMsg.subscribeTo(kept[-1])
    scene.SelfInit()
    scene.Reset(0)
    qpos, qvel = (scene.dynManager.getStateObject(f"mujoco{n}") for n in ("Qpos", "Qvel"))
    qpos.setState([[x] for x in key.key_qpos[0]])
    qvel.setState([[x] for x in key.key_qvel[0]])
    for i in range(steps + 1):  # the first has no length and fills the messages
        scene.UpdateState(i * step_ns)
    print(json.dumps(np.ravel(qpos.getState()).tolist()))


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]), round(float(sys.argv[3]) * 1e9))
