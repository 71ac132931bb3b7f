"""One file per section of VALIDATION.md, each with a function run(runner, plots) -> Section. A new
section is a file here and a line below."""

from sections import burn, flex, multibody, orbit, panels, torque, work_precision
from sections import basilisk, cost, truth, why

# The order of the document; what depends on the machine that ran it comes last.
SECTIONS = (orbit, torque, panels, multibody, burn, flex, why, work_precision, truth, basilisk, cost)
