"""A server of Universal Robots' Real-Time Data Exchange, protocol version 2, for one client on the loopback.

It runs in a process of its own, since the client holds Python's global lock while it connects: each line of its
input replaces values, the end of input ends it; its last line names what was asked.

Packages are ``uint16 size, uint8 type, payload``, big-endian, as in "Real-Time Data Exchange (RTDE) Guide".
"""

from __future__ import annotations

import json
import socket
import struct
import sys
import threading

REQUEST_PROTOCOL_VERSION = ord("V")
GET_URCONTROL_VERSION = ord("v")
SETUP_OUTPUTS = ord("O")
SETUP_INPUTS = ord("I")
START = ord("S")
PAUSE = ord("P")
DATA = ord("U")

VECTORS = ("target_q", "target_qd", "target_qdd", "target_current", "target_moment", "actual_q", "actual_qd")
VECTORS += ("actual_current", "joint_control_output", "actual_TCP_pose", "actual_TCP_speed", "actual_TCP_force")
VECTORS += (
    "target_TCP_pose",
    "target_TCP_speed",
    "joint_temperatures",
    "actual_joint_voltage",
    "ft_raw_wrench",
    "payload_inertia",
)
INT_VECTORS = ("joint_mode",)
DOUBLES = ("timestamp", "actual_execution_time", "speed_scaling", "target_speed_fraction", "actual_momentum")
DOUBLES += ("actual_main_voltage", "actual_robot_voltage", "actual_robot_current", "standard_analog_input0")
DOUBLES += ("standard_analog_input1", "standard_analog_output0", "standard_analog_output1", "payload")
UINT64 = ("actual_digital_input_bits", "actual_digital_output_bits")
UINT32 = ("runtime_state", "robot_status_bits", "safety_status_bits")
INT32 = ("robot_mode", "safety_mode", "safety_status")
THREE = ("actual_tool_accelerometer", "payload_cog")
FORMATS = {"VECTOR6D": "6d", "VECTOR3D": "3d", "VECTOR6INT32": "6i", "DOUBLE": "d"}
FORMATS |= {"UINT64": "Q", "UINT32": "I", "INT32": "i"}


def type_of(name):
    """The type of a field of an output recipe, as the guide has it."""
    groups = {"VECTOR6D": VECTORS, "VECTOR6INT32": INT_VECTORS, "DOUBLE": DOUBLES, "UINT64": UINT64}
    groups |= {"UINT32": UINT32, "INT32": INT32, "VECTOR3D": THREE}
    for kind, names in groups.items():
        if name in names:
            return kind
    if name.startswith("output_int_register"):
        return "INT32"
    if name.startswith("output_double_register"):
        return "DOUBLE"
    if name.startswith("output_bit_registers"):
        return "UINT32"
    return "NOT_FOUND"


class RtdeServer:
    """Answers the handshake, then sends data packages until it is closed."""

    def __init__(self, address, values, port=30004):
        self.values = dict(values)
        self.requests = []
        self.recipe = []
        self.unknown = []
        self._socket = socket.create_server((address, port))
        self._closing = threading.Event()
        self._thread = threading.Thread(target=self._serve, daemon=True)
        self._thread.start()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._closing.set()
        # A thread that waits for a client is woken by one.
        self._socket.close()
        self._thread.join(timeout=10)

    def _serve(self):
        self._socket.settimeout(0.05)
        while not self._closing.is_set():
            try:
                client, _ = self._socket.accept()
            except TimeoutError:
                continue
            except OSError:
                return
            with client:
                self._talk(client)

    def _talk(self, client):
        client.settimeout(0.002)
        is_started, pending, time_s = False, b"", 0.0
        while not self._closing.is_set():
            try:
                received = client.recv(4096)
                if not received:
                    return
                pending += received
            except TimeoutError:
                pass
            except OSError:
                return
            while len(pending) >= 3 and len(pending) >= struct.unpack_from(">H", pending)[0]:
                size, kind = struct.unpack_from(">HB", pending)
                is_started = self._answer(client, kind, pending[3:size], is_started=is_started)
                pending = pending[size:]
            if is_started:
                time_s += 0.008
                try:
                    client.sendall(_package(DATA, self._data(time_s)))
                except OSError:
                    return

    def _answer(self, client, kind, payload, *, is_started):
        self.requests.append(chr(kind))
        if kind == REQUEST_PROTOCOL_VERSION:
            (version,) = struct.unpack(">H", payload)
            client.sendall(_package(kind, struct.pack(">B", version == 2)))
        elif kind == GET_URCONTROL_VERSION:
            client.sendall(_package(kind, struct.pack(">4I", 5, 11, 0, 0)))
        elif kind == SETUP_OUTPUTS:
            self.recipe = payload[8:].decode().rstrip(",").split(",")
            types = [type_of(name) for name in self.recipe]
            self.unknown += [name for name, found in zip(self.recipe, types, strict=True) if found == "NOT_FOUND"]
            client.sendall(_package(kind, b"\x01" + ",".join(types).encode()))
        elif kind == SETUP_INPUTS:
            client.sendall(_package(kind, b"\x01" + b",".join(b"INT32" for _ in payload.split(b","))))
        elif kind in (START, PAUSE):
            client.sendall(_package(kind, b"\x01"))
            return kind == START
        return is_started

    def _data(self, time_s):
        values = {"timestamp": time_s, **self.values}
        parts = [b"\x01"]
        for name in self.recipe:
            layout = FORMATS[type_of(name)]
            count = int(layout[:-1] or 1)
            value = values.get(name, 0)
            row = value if isinstance(value, tuple) else (value,) * count
            parts.append(struct.pack(f">{layout}", *row))
        return b"".join(parts)


def _package(kind, payload):
    return struct.pack(">HB", 3 + len(payload), kind) + payload


def _say(line):
    sys.stdout.write(f"{line}\n")
    sys.stdout.flush()


def main(address):
    """Serve until the input ends."""
    with RtdeServer(address, {}) as server:
        _say("listening")
        for line in sys.stdin:
            changed = {name: tuple(v) if isinstance(v, list) else v for name, v in json.loads(line).items()}
            server.values.update(changed)
            _say("changed")
    _say(json.dumps({"requests": server.requests, "unknown": server.unknown}))


if __name__ == "__main__":
    main(sys.argv[1])
