#!/usr/bin/env python3
"""Prints the objects of each frame, of a log or as they come:

    lcm-gen -p --ppath logs/python lcmtypes/*.lcm
    PYTHONPATH=logs/python lcmtypes/read_objects.py logs/run.lcm
    PYTHONPATH=logs/python lcmtypes/read_objects.py 239.255.76.67:7667
"""
import socket
import struct
import sys

from declutter import object_list_t


def log_messages(path):
    """Channel and bytes of each message of a log."""
    with open(path, "rb") as log:
        while header := log.read(28):
            _, _, _, channel_size, size = struct.unpack(">IqqII", header)
            yield log.read(channel_size).decode(), log.read(size)


def live_messages(address, port):
    """Channel and bytes of each message below 64 KB on the network udpm://address:port."""
    bus = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    bus.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    bus.bind((address, port))
    group = socket.inet_aton(address) + socket.inet_aton("0.0.0.0")
    bus.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, group)
    while True:
        packet = bus.recv(65536)
        if packet[:4] == b"LC02":  # else a part of a larger message
            channel, message = packet[8:].split(b"\0", 1)
            yield channel.decode(), message


def main(place):
    if ":" in place:
        address, port = place.split(":")
        messages = live_messages(address, int(port))
    else:
        messages = log_messages(place)
    for channel, message in messages:
        if channel == "OBJECTS":
            frame = object_list_t.decode(message)
            print(frame.utime, frame.num_objects, "objects", flush=True)


if __name__ == "__main__":
    main(sys.argv[1])
