#pragma once

#include <string>

namespace declutter::launcher {

// An LCM url of this machine alone, on a port that nothing uses, so that two graphs never mix, with
// the largest receive buffer that the kernel grants up to 4 MiB.
// num_refused: how many of those chosen before could not be had.
std::string ChooseUrl(int num_refused = 0);

// The url with the largest receive buffer that the system allows, where it names none: with the
// usual one a busy machine loses the larger messages.
std::string WithReceiveBuffer(const std::string& url);

// Proves with a message of 150 KB, more than the largest of ours needs, that the url carries
// messages. Where it does not (no multicast route, or fragments are lost) moves this process into
// a network of its own, which holds nothing but the loopback, and proves it there; what we start
// later inherits it; true when it has. Needs a process of one thread. Throws std::runtime_error
// with what was tried.
bool EnsureMulticast(const std::string& url);

// True when a message of 150 KB arrives over url.
bool CarriesMessages(const std::string& url);

// True when this user may make a network of his own.
bool CanIsolate();

// Moves this process into a network of its own in any case. As above.
void Isolate();

}  // namespace declutter::launcher
