#pragma once
// The tape as a bar: where it stands, and the in and out points, all to be dragged.
#include "deck.h"

namespace welkin::window {

// Above, a drag moves along the tape; below, it takes the nearer point, which a double click brings back to its end. True: it stands
// elsewhere now.
bool tapeBar(Deck& deck);

}  // namespace welkin::window
