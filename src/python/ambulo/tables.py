"""Lists of records as tables."""

from typing import Sequence

from .records import Record


def to_pandas(values: Sequence[Record]):
    """A pandas.DataFrame with a line for each record and a column for each of its fields."""
    import pandas

    return pandas.DataFrame([value.to_dict() for value in values])
