// xdnd_source WINDOW FILE...: drops files onto an X11 window, as a file manager does (XDND, version 5:
// freedesktop.org/wiki/Specifications/XDND). Exit 0 once the window says that it has them, 1 after some seconds without that.
#include <X11/Xatom.h>
#include <X11/Xlib.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

namespace {

constexpr int kVersion = 5, kPatience = 6000;  // of 10 ms: a busy machine takes long

std::string uriList(int count, char** files) {
  std::string list;
  for (int i = 0; i < count; ++i) {
    list += "file://";
    for (const char c : std::filesystem::absolute(files[i]).string()) {
      const bool plain =
          (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '/' || c == '.' || c == '-' || c == '_';
      char coded[4];
      std::snprintf(coded, sizeof(coded), "%%%02X", static_cast<unsigned char>(c));
      list += plain ? std::string(1, c) : coded;
    }
    list += "\r\n";
  }
  return list;
}

struct Source {
  Display* display;
  Window self, target;
  Atom atom(const char* name) const { return XInternAtom(display, name, False); }
  void send(const char* type, long b, long c, long d, long e) const {
    XEvent event{};
    event.xclient = {ClientMessage, 0, True, display, target, atom(type), 32, {}};
    const long data[5] = {static_cast<long>(self), b, c, d, e};
    for (int i = 0; i < 5; ++i) event.xclient.data.l[i] = data[i];
    XSendEvent(display, target, False, NoEventMask, &event);
    XFlush(display);
  }
  void answer(const XSelectionRequestEvent& asked, const std::string& list) const {
    XChangeProperty(display, asked.requestor, asked.property, asked.target, 8, PropModeReplace,
                    reinterpret_cast<const unsigned char*>(list.data()), static_cast<int>(list.size()));
    XEvent event{};
    event.xselection = {SelectionNotify, 0, True, display, asked.requestor, asked.selection, asked.target, asked.property, asked.time};
    XSendEvent(display, asked.requestor, False, NoEventMask, &event);
    XFlush(display);
  }
};

}  // namespace

int main(int argc, char** argv) {
  Display* display = argc > 2 ? XOpenDisplay(nullptr) : nullptr;
  if (!display) {
    std::fprintf(stderr, "usage: xdnd_source WINDOW FILE..., with a display\n");
    return 2;
  }
  const Source source{display, XCreateSimpleWindow(display, DefaultRootWindow(display), 0, 0, 1, 1, 0, 0, 0),
                      std::strtoul(argv[1], nullptr, 0)};
  const std::string list = uriList(argc - 2, argv + 2);
  XSetSelectionOwner(display, source.atom("XdndSelection"), source.self, CurrentTime);
  source.send("XdndEnter", static_cast<long>(kVersion) << 24, static_cast<long>(source.atom("text/uri-list")), 0, 0);
  source.send("XdndPosition", 0, 100L << 16 | 100, CurrentTime, static_cast<long>(source.atom("XdndActionCopy")));
  for (int i = 0; i < kPatience; ++i, usleep(10'000)) {
    while (XPending(display)) {
      XEvent event;
      XNextEvent(display, &event);
      if (event.type == SelectionRequest) source.answer(event.xselectionrequest, list);
      if (event.type != ClientMessage) continue;
      if (event.xclient.message_type == source.atom("XdndStatus")) source.send("XdndDrop", 0, CurrentTime, 0, 0);
      if (event.xclient.message_type == source.atom("XdndFinished")) return 0;
    }
  }
  std::fprintf(stderr, "xdnd_source: no answer\n");
  return 1;
}
