"""The size of a motor: torque, power and energy over one turn of a driven four-bar, without integrating."""

import numpy as np

import symgen

linkage = symgen.load("driven-four-bar")
times = np.linspace(0.0, 1.0, 361)

motion = linkage.kinematics(times)
print(f"rocker swings by {np.degrees(np.ptp(motion['rocker.theta'])):.1f} degrees")
print(f"largest force in pin C: {motion['C.F'].max():.0f} N")

needed = linkage.inverse(times=times)
motor = needed.summary()["motor"]
print(f"motor: up to {motor['max']:.0f} N m, effective {motor['rms']:.0f} N m, up to {motor['peak_power']:.0f} W")
needed.plot("motor.pdf", ["motor.effort", "motor.power"], over="crank.theta")
