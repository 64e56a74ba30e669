"""Exceptions and messages."""

from typing import NamedTuple, Optional, Sequence


class Message(NamedTuple):
    """One message about an input."""

    severity: str
    """"note", "warning" or "error"."""
    message: str
    """What is wrong (got X); expected Y."""
    file: Optional[str]
    """None: it is not about a file."""
    line: int
    """From 1 on; 0: no position."""
    column: int
    path: Optional[str]
    """Of the key, such as "links[3].body.mass"."""
    hint: Optional[str]
    """"did you mean 'mass'?"."""
    text: str
    """All of it, as the program prints it: "file:line:column: error[E_SCHEMA]: ..."."""

    def __str__(self):
        return self.text


class AmbuloError(Exception):
    """A call that was not legal or could not be carried out.

    ``status``    its code by name: "E_SCHEMA" (status.h has them all)
    ``messages``  what was found, with file, line and column: a list of Message
    """

    def __init__(self, status: str, text: str, messages: Sequence[Message] = ()):
        self.status, self.messages, self._made_of = status, list(messages), (status, text, messages)
        errors = [message.text for message in self.messages if message.severity == "error"]
        super().__init__("\n".join(errors) if errors else f"{status}: {text}")

    def __reduce__(self):
        return type(self), self._made_of


class AmbuloWarning(UserWarning):
    """Something that is only doubted, or holds less than it seems. Warnings of the library come
    through Python's ``warnings``, which can silence them or make them errors."""
