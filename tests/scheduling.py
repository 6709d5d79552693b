"""How the tests are dealt out to several processes: a file at a time, what takes longest first, so that none is left over.

The browser tests are one pile, so that one server of the explorer serves them all; the pages of the documentation are sessions
apart, so that each is a pile of its own.
"""

from xdist.scheduler import LoadFileScheduling

EXPLORER = "tests/view/test_explorer"
APART = "tests/test_documentation.py"
LONGEST_FIRST = (
    EXPLORER,
    "src/quartering/study/seas/lyapunov.py",
    "tests/test_documentation.py::test_python_of_the_pages_gives_what_they_show[six_degrees.md]",
    "tests/study/test_irregular_six_modes.py",
    "tests/test_documentation.py::test_python_of_the_pages_gives_what_they_show[a_real_sea.md]",
    "tests/motion/test_escape.py",
    "tests/motion/test_autopilot.py",
    "tests/motion/test_irregular.py",
    "tests/motion/test_gaussian_averages.py",
    "tests/loads/test_diffraction.py",
    "tests/view/test_report.py",
    "tests/view/test_commands.py",
    "tests/hydro/test_coefficients.py",
    "tests/paper/test_claims.py",
    "tests/hull/test_righting.py",
    "tests/test_options.py",
    "tests/study/test_branch.py",
    "tests/loads/test_panels.py",
    "tests/study/test_simulated_sea.py",
    "tests/hydro/test_ends.py",
    "tests/study/criteria/test_failure_modes.py",
    "tests/study/test_same_bytes.py",
    "tests/loads/test_bem.py",
    "tests/hydro/test_six_modes.py",
    "tests/study/test_every_branch.py",
    "tests/view/test_rates_commands.py",
    "tests/study/test_polar_of_six_modes.py",
    "tests/motion/test_righting_spline.py",
    "tests/study/test_store.py",
    "tests/stability/test_parametric.py",
    "tests/stability/test_hill_equations.py",
    "tests/study/test_direct_assessment.py",
    "tests/loads/test_own_database.py",
    "tests/motion/test_capsize_limit.py",
    "tests/hydro/test_closefit.py",
    "tests/view/test_start_up.py",
    "tests/study/test_branch_of_six_modes.py",
    "tests/view/test_ship_in_wave.py",
    "src/quartering/study/seas/simulated/simulation.py",
    "tests/loads/test_wigley3.py",
    "tests/study/test_guidance.py",
    "tests/view/test_motion_commands.py",
    "tests/study/test_vary.py",
    "tests/test_machine_code.py",
    "tests/view/test_hostile_input.py",
    "tests/loads/test_roll_excitation.py",
    "tests/stability/test_ships_of_another_code.py",
    "tests/motion/test_all_motions.py",
    "tests/hydro/test_double_body.py",
    "tests/view/test_sea_command.py",
    "tests/view/test_sweep_commands.py",
    "tests/study/criteria/test_operational.py",
    "tests/hydro/test_kramers_kronig.py",
    "tests/view/test_sea_polar_command.py",
    "tests/view/test_paper_figures.py",
    "tests/view/test_two_side_by_side.py",
    "tests/view/test_criteria_command.py",
    "tests/study/test_exact_derivatives.py",
    "tests/view/test_decay_command.py",
    "tests/study/test_broaching.py",
    "tests/motion/test_approach.py",
)
"""What is begun first: the browser tests; beside them what compiles kernels that others need later, so that only one process
compiles them; then what took more than six seconds of processor time, the longest first."""


def pile(nodeid: str) -> str:
    """Name of what is dealt out together with a test.

    Examples
    --------
    >>> pile("tests/view/test_explorer_sea.py::test_one")
    'tests/view/test_explorer'
    >>> pile("tests/hull/test_ship.py::test_one[a::b]")
    'tests/hull/test_ship.py'
    """
    if nodeid.startswith(APART):
        return nodeid
    return EXPLORER if nodeid.startswith(EXPLORER) else nodeid.split("::", 1)[0]


class LongestFirst(LoadFileScheduling):
    """Deals out files, the longest first."""

    def _split_scope(self, nodeid):
        return pile(nodeid)

    def _assign_work_unit(self, node):
        self.workqueue.move_to_end(min(self.workqueue, key=self._turn), last=False)
        super()._assign_work_unit(node)

    def _turn(self, name):
        place = LONGEST_FIRST.index(name) if name in LONGEST_FIRST else len(LONGEST_FIRST)
        return place, -len(self.workqueue[name])
