"""What is raised where the input cannot be used."""


class InputError(ValueError):
    """Input that cannot be used. The message says what, where and what is allowed.

    `path` is the file, or the name of the text or dict at fault; `line` and `column` count from 1. Each is None where it
    is not known.
    """

    def __init__(
        self,
        message: str,
        path: str | None = None,
        line: int | None = None,
        column: int | None = None,
    ) -> None:
        super().__init__(message, path, line, column)
        self.message, self.path, self.line, self.column = message, path, line, column

    def __str__(self) -> str:
        return self.message
