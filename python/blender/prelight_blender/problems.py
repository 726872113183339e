"""The exception for problems that stop a bake."""


class Problem(Exception):
    """A problem: `what` is wrong, and the `fix` for users. The panel shows both."""

    def __init__(self, what, fix=""):
        self.what, self.fix = what, fix
        super().__init__(f"{what} ({fix})" if fix else what)
