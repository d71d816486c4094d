"""A controller of UFACTORY's arms for one client on the loopback: its private Modbus TCP and its report port.

Requests and replies are ``uint16 transaction, uint16 protocol, uint16 length, uint8 register``, in a reply
``uint8 state``, and the parameters; integers are big-endian, 32-bit floats little-endian. The report port sends the
first 245 bytes of the rich report. Both as in UFACTORY's "xArm Developer Manual", which lists the registers.
"""

from __future__ import annotations

import socket
import struct
import threading

PROTOCOLS = (2, 3)
REPORT_PORT = 30002
GET_VERSION, MOTION_ENABLE, SET_STATE, GET_STATE, GET_ERROR, SET_MODE = 1, 11, 12, 13, 15, 19
MOVE_SERVO_JOINT, GET_JOINT_POSITIONS, WRITE_TOOL_REGISTER = 29, 42, 127
TOOL_OUTPUTS = 0x0A15
HAS_ERROR, IS_NOT_READY = 0x40, 0x10
LITE6 = "6,9,LI1006000000,AL1006000000,v2.5.0"
"""What a Lite6 answers: axes, type, serial numbers, version of the firmware."""


class XarmServer:
    """An arm that follows its set points at once.

    Attributes:
        angles: Seven joint angles in rad.
        error: Code of a pending error; 0 if there is none.
        outputs: The two outputs at the tool.
        requests: The registers that were asked, but for the states of joints and of the controller.
        points: The set points, seven values in rad each.
        is_silent: Whether it gives no answer any more.
        takes_modes: Whether it changes its mode when it is asked to.
        version: What it says that it is.
    """

    def __init__(self, address, version=LITE6):
        self.angles, self.error, self.outputs, self.state, self.mode = [0.0] * 7, 0, [0, 0], 5, 0
        self.requests, self.points, self.is_silent, self.takes_modes = [], [], False, True
        self.version = version
        self._control = socket.create_server((address, 0))
        self._report = socket.create_server((address, REPORT_PORT))
        self.control_port = self._control.getsockname()[1]
        self._closing = threading.Event()
        ways = ((self._control, self._talk), (self._report, self._tell))
        self._threads = [threading.Thread(target=self._serve, args=way, daemon=True) for way in ways]
        for thread in self._threads:
            thread.start()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._closing.set()
        for thread in self._threads:
            thread.join(timeout=10)

    def _serve(self, listener, talk):
        listener.settimeout(0.05)
        with listener:
            while not self._closing.is_set():
                try:
                    client, _ = listener.accept()
                except TimeoutError:
                    continue
                with client:
                    talk(client)

    def _talk(self, client):
        client.settimeout(0.01)
        pending = b""
        while not self._closing.is_set():
            try:
                received = client.recv(4096)
            except TimeoutError:
                continue
            except OSError:
                return
            if not received:
                return
            pending += received
            while len(pending) >= 6 and len(pending) >= 6 + struct.unpack_from(">H", pending, 4)[0]:
                transaction, protocol, length = struct.unpack_from(">3H", pending)
                asked, pending = pending[6 : 6 + length], pending[6 + length :]
                if protocol in PROTOCOLS and not self.is_silent:
                    answer = bytes([asked[0], self._status()]) + self._answer(asked[0], asked[1:])
                    client.sendall(struct.pack(">3H", transaction, protocol, len(answer)) + answer)

    def _status(self):
        ready = 0 if self.state < 4 and not self.error else IS_NOT_READY
        return ready | (HAS_ERROR if self.error else 0)

    def _answer(self, register, parameters):
        if register == GET_JOINT_POSITIONS:
            rows = parameters[0] & 0x0F
            return struct.pack(f"<{7 * rows}f", *self.angles, *([0.0] * (7 * (rows - 1))))
        if register == GET_STATE:
            return bytes([self.state])
        if register == GET_ERROR:
            return bytes([self.error, 0])
        self.requests.append(register)
        if register == GET_VERSION:
            return self.version.encode().ljust(40, b"\0")
        if register == SET_STATE:
            self.state = {0: 2}.get(parameters[0], parameters[0])
        elif register == SET_MODE and self.takes_modes:
            self.mode = parameters[0]
        elif register == MOVE_SERVO_JOINT:
            point = struct.unpack_from("<7f", parameters)
            self.points.append(point)
            if self.mode == 1 and self.state < 4:
                self.angles = list(point)
        elif register == WRITE_TOOL_REGISTER:
            _, address, value = struct.unpack_from(">BHf", parameters)
            value = int(struct.unpack_from("<f", parameters, 3)[0])
            assert address == TOOL_OUTPUTS
            for output in (0, 1):
                if value & 0x0100 << output:
                    self.outputs[output] = value >> output & 1
        return b""

    def _tell(self, client):
        while not self._closing.wait(0.02):
            report = struct.pack(">IBH", 245, self.mode << 4 | self.state, 0)
            report += struct.pack("<20f", *self.angles, *([0.0] * 13))
            report += bytes([0x7F, 0x7F, self.error, 0])
            report += struct.pack("<10f", *([0.0] * 10)) + bytes([3, 3]) + struct.pack("<3f", 0.0, 0.0, -1.0)
            axes, kind = (int(value) for value in self.version.split(",")[:2])
            report += bytes([kind, axes, 0, 0, 0, 0]) + b"v2.5.0".ljust(30, b"\0")
            report += struct.pack("<12f", *([1000.0] * 12)) + bytes(16)
            if not self.is_silent:
                try:
                    client.sendall(report)
                except OSError:
                    return
