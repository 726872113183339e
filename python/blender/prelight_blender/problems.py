"""What stops a bake."""


class Problem(Exception):
    """`what` is wrong, and how the user `fix`es it; the panel shows both."""

    def __init__(self, what, fix=""):
        self.what, self.fix = what, fix
        super().__init__(f"{what} ({fix})" if fix else what)
