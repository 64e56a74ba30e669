"""The skeleton."""

from typing import TYPE_CHECKING, Any, Dict, List, NamedTuple, Optional, Sequence, Union

import numpy

from . import _records as records
from ._native import Call, Handle, Owner, ffi, lib, overrides_of, path_of, text_of
from .errors import AmbuloError
from .records import Carrier, from_c

if TYPE_CHECKING:
    from .mechanics import PointMotion

NULL = ffi.NULL
KINDS = ("link", "coordinate", "point", "foot", "patch", "capsule")


class InverseDynamics(NamedTuple):
    """What a motion takes; n time nodes, d coordinates, p points."""

    tau: numpy.ndarray
    """[n][d]: generalized force at each coordinate, N m or N."""
    wrench: numpy.ndarray
    """[n][6]: what the surroundings must apply to the body: moment about the world's origin (N m),
    then force (N), world axes."""
    points: numpy.ndarray
    """[n][p][3]: positions of the model's points, world axes, m."""


class Model(Owner):
    """A tree of links, read from a file or made from records; it never changes.

    >>> model = ambulo.Model.load(ambulo.MODELS / "lower_body_18.yaml", mass=70, stature=1.8)
    >>> model.coordinate_names[:3]
    ['pelvis_tx', 'pelvis_ty', 'pelvis_tz']

    Units are SI and radians, always. A model may be used by several threads at once.
    """

    def __init__(self, handle: Handle):
        self._handle = handle
        self._lists: Dict[str, List[Any]] = {}

    # --------------------------------------------------------------- making one

    @classmethod
    def load(cls, path, overrides=None, *, mass: Optional[float] = None,
             stature: Optional[float] = None, sex: str = "not_set") -> "Model":
        """Reads a model file (docs/model-format.md).

        ``overrides`` replace values of the file before it is read: a dictionary by paths such as
        ``"links[shank_r].body.mass"``. ``mass`` (kg), ``stature`` (m) and ``sex`` ("female",
        "male") are the person that the model is scaled to; None keeps what the file says.
        """
        texts, count, _keep = overrides_of(overrides)
        subject = Carrier().new(records.Subject(mass=mass, stature=stature, sex=sex))
        out = ffi.new("ambulo_model **")
        with Call() as call:
            call(lib.ambulo_model_load_with(path_of(path), texts, count, subject, NULL,
                                            call.messages, out))
        return cls(Handle(out[0], lib.ambulo_model_free))

    @classmethod
    def load_text(cls, text: str, name: str = "model", *, mass: Optional[float] = None,
                  stature: Optional[float] = None, sex: str = "not_set") -> "Model":
        """The same from text; ``name`` stands for the file in messages."""
        data = text.encode()
        subject = Carrier().new(records.Subject(mass=mass, stature=stature, sex=sex))
        out = ffi.new("ambulo_model **")
        with Call() as call:
            call(lib.ambulo_model_load_text(data, len(data), name.encode(), subject, NULL,
                                            call.messages, out))
        return cls(Handle(out[0], lib.ambulo_model_free))

    @classmethod
    def create(cls, links: Sequence[records.Link], coordinates: Sequence[records.Coordinate],
               points: Sequence[records.Point] = (), **fields) -> "Model":
        """Makes a model from records.

        ``coordinates[k]`` describes the k-th link that has one. Names may stand for numbers, as in
        ``Link("forearm", parent="upper_arm", type="revolute", ...)``. Further fields are those of
        ``ModelDefinition``: ``name``, ``gravity``, ``forward``, ``feet``, ``stature``, ``patches``,
        ``capsules``.
        """
        definition = records.ModelDefinition(links=list(links), coordinates=list(coordinates),
                                             points=list(points), **fields)
        lists = {"link": definition.links, "coordinate": definition.coordinates,
                 "point": definition.points, "foot": definition.feet,
                 "patch": definition.patches, "capsule": definition.capsules}

        def find(what, name):
            for number, item in enumerate(lists[what] or ()):
                if item.name == name:
                    return number
            raise ValueError(f"there is no {what} '{name}'")

        carrier = Carrier(find=find)
        struct = carrier.new(definition)
        out = ffi.new("ambulo_model **")
        with Call() as call:
            call(lib.ambulo_model_create(struct, NULL, call.messages, out))
        return cls(Handle(out[0], lib.ambulo_model_free))

    def adapt(self, *, slope: float = 0, load_link: Union[int, str] = -1, load_mass: float = 0,
              load_position: Sequence[float] = (0, 0, 0)) -> "Model":
        """A copy of the model on ground that rises by ``slope`` (rad), or with a mass (kg) fixed on
        a link at a place in its frame (m). Loads add up, a slope replaces the one before."""
        conditions = records.Conditions(slope=slope, load_link=load_link, load_mass=load_mass,
                                        load_position=load_position)
        struct = Carrier(find=self.find).new(conditions)
        out = ffi.new("ambulo_model **")
        with Call() as call:
            call(lib.ambulo_model_adapt(self._pointer, struct, NULL, call.messages, out))
        return Model(Handle(out[0], lib.ambulo_model_free))

    # ------------------------------------------------------------------ queries

    def _list(self, what: str, kind) -> List[Any]:
        pointer = self._pointer
        if what not in self._lists:
            count = getattr(lib, f"ambulo_model_{what}_count")(pointer)
            get = getattr(lib, f"ambulo_model_{what}")
            self._lists[what] = [from_c(kind, get(pointer, i)) for i in range(count)]
        return list(self._lists[what])

    @property
    def name(self) -> Optional[str]:
        return self._read(text_of, lib.ambulo_model_name)

    @property
    def links(self) -> List[records.Link]:
        """Every parent before its children."""
        return self._list("link", records.Link)

    @property
    def coordinates(self) -> List[records.Coordinate]:
        """In the order of the columns of all motions."""
        return self._list("coordinate", records.Coordinate)

    @property
    def points(self) -> List[records.Point]:
        return self._list("point", records.Point)

    @property
    def feet(self) -> List[records.Foot]:
        return self._list("foot", records.Foot)

    @property
    def patches(self) -> List[records.Patch]:
        return self._list("patch", records.Patch)

    @property
    def capsules(self) -> List[records.Capsule]:
        return self._list("capsule", records.Capsule)

    @property
    def coordinate_names(self) -> List[str]:
        return [item.name for item in self._list("coordinate", records.Coordinate)]

    @property
    def point_names(self) -> List[str]:
        return [item.name for item in self._list("point", records.Point)]

    def find(self, what: str, name: str) -> int:
        """The number of a "link", "coordinate", "point", "foot", "patch" or "capsule"."""
        if what not in KINDS:
            raise ValueError(f"'{what}'; expected one of {', '.join(KINDS)}")
        number = getattr(lib, f"ambulo_model_find_{what}")(self._pointer, name.encode())
        if number < 0:
            raise ValueError(f"the model '{self.name}' has no {what} '{name}'")
        return number

    @property
    def mass(self) -> float:
        """Of the whole body, kg."""
        return lib.ambulo_model_mass(self._pointer)

    @property
    def stature(self) -> float:
        """m; 0: unknown."""
        return lib.ambulo_model_stature(self._pointer)

    def _direction(self, which: str) -> numpy.ndarray:
        return self._read(lambda found: numpy.array(list(found[0:3])),
                          getattr(lib, f"ambulo_model_{which}"))

    @property
    def gravity(self) -> numpy.ndarray:
        """[3], m/s^2, world axes."""
        return self._direction("gravity")

    @property
    def up(self) -> numpy.ndarray:
        return self._direction("up")

    @property
    def forward(self) -> numpy.ndarray:
        return self._direction("forward")

    @property
    def left(self) -> numpy.ndarray:
        return self._direction("left")

    def mirror_faults(self) -> List[str]:
        """Where the body is not its own mirror image, in words; empty where it is."""
        call = Call()
        try:
            call(lib.ambulo_model_check_mirror(self._pointer, NULL, call.messages))
        except AmbuloError as fault:
            if fault.status != "E_MODEL":
                raise
            return [message.message for message in fault.messages]
        return []

    def contacts_of(self, gait: records.Gait) -> List[records.Contact]:
        """The contacts of a regular walk, for ``Problem.create(model, contacts=...)``."""
        struct = Carrier(find=self.find).new(gait)
        room, count = 32, ffi.new("int *")
        while True:
            contacts = ffi.new("ambulo_contact[]", room)
            status = lib.ambulo_gait_expand(self._pointer, struct, contacts, room, count)
            if status != records.Status.E_LIMIT or count[0] <= room:
                break
            room = count[0]
        with Call() as call:
            call(status)
        return [from_c(records.Contact, contacts[i]) for i in range(count[0])]

    # ---------------------------------------------------------------- mechanics

    def inverse_dynamics(self, q, qd=None, qdd=None) -> InverseDynamics:
        """Torques, root wrench and points of a motion: ``Mechanics(model).inverse_dynamics``."""
        from .mechanics import Mechanics

        with Mechanics(self) as mechanics:
            return mechanics.inverse_dynamics(q, qd, qdd)

    def point_motion(self, link: Union[int, str], local, q, qd) -> "PointMotion":
        """Position and velocity of any point at one state, with their slopes: ``local`` (m) in the
        frame of a link, by its name or number (-1: the world); ``q``, ``qd`` [d]. For terms and
        rows of one's own: ``gradient.q += slope @ found.velocity_q`` and
        ``gradient.qd += slope @ found.position_q`` carry slopes by the velocity over."""
        from .mechanics import point_motion

        return point_motion(self, link, local, q, qd)

    def __repr__(self):
        if self._handle is None:
            return "<Model, closed>"
        return (f"<Model {self.name}: {len(self.links)} links, {len(self.coordinates)} coordinates, "
                f"{self.mass:.4g} kg>")
