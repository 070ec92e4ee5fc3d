// The least window manager that can maximise, for scripts/check_window.py: windows lie where they ask to, and those whose _NET_WM_STATE
// asks for it (Extended Window Manager Hints 1.5) cover the screen.
#include <X11/Xatom.h>
#include <X11/Xlib.h>

#include <cstdio>
#include <vector>

namespace {

Display* g_display;
Atom atom(const char* name) { return XInternAtom(g_display, name, False); }

bool wantsAll(Window window) {
  Atom type;
  int format;
  unsigned long count = 0, left;
  unsigned char* data = nullptr;
  XGetWindowProperty(g_display, window, atom("_NET_WM_STATE"), 0, 16, False, XA_ATOM, &type, &format, &count, &left, &data);
  bool found = false;
  for (unsigned long i = 0; data && format == 32 && i < count; ++i)
    found = found || reinterpret_cast<const Atom*>(data)[i] == atom("_NET_WM_STATE_MAXIMIZED_VERT");
  if (data) XFree(data);
  return found;
}

void setAll(Window window) {
  const Atom both[] = {atom("_NET_WM_STATE_MAXIMIZED_VERT"), atom("_NET_WM_STATE_MAXIMIZED_HORZ")};
  XChangeProperty(g_display, window, atom("_NET_WM_STATE"), XA_ATOM, 32, PropModeReplace, reinterpret_cast<const unsigned char*>(both), 2);
  XMoveResizeWindow(g_display, window, 0, 0, unsigned(DisplayWidth(g_display, 0)), unsigned(DisplayHeight(g_display, 0)));
}

int ignore(Display*, XErrorEvent*) { return 0; }  // a window that is gone by now

}  // namespace

int main() {
  g_display = XOpenDisplay(nullptr);
  if (!g_display) return 1;
  XSetErrorHandler(ignore);
  const Window root = DefaultRootWindow(g_display), self = XCreateSimpleWindow(g_display, root, 0, 0, 1, 1, 0, 0, 0);
  for (const Window w : {root, self})
    XChangeProperty(g_display, w, atom("_NET_SUPPORTING_WM_CHECK"), XA_WINDOW, 32, PropModeReplace,
                    reinterpret_cast<const unsigned char*>(&self), 1);
  const std::vector<Atom> known{atom("_NET_WM_STATE"), atom("_NET_WM_STATE_MAXIMIZED_VERT"), atom("_NET_WM_STATE_MAXIMIZED_HORZ")};
  XChangeProperty(g_display, root, atom("_NET_SUPPORTED"), XA_ATOM, 32, PropModeReplace,
                  reinterpret_cast<const unsigned char*>(known.data()), int(known.size()));
  XSelectInput(g_display, root, SubstructureRedirectMask | SubstructureNotifyMask);
  std::puts("ready");
  std::fflush(stdout);
  for (XEvent e;;) {
    XNextEvent(g_display, &e);
    if (e.type == ConfigureRequest) {
      const auto& c = e.xconfigurerequest;
      XWindowChanges changes{c.x, c.y, c.width, c.height, c.border_width, c.above, c.detail};
      XConfigureWindow(g_display, c.window, unsigned(c.value_mask), &changes);
    } else if (e.type == MapRequest) {
      if (wantsAll(e.xmaprequest.window)) setAll(e.xmaprequest.window);
      XMapWindow(g_display, e.xmaprequest.window);
      XSetInputFocus(g_display, e.xmaprequest.window, RevertToPointerRoot, CurrentTime);
    } else if (e.type == ClientMessage && e.xclient.message_type == atom("_NET_WM_STATE") && e.xclient.data.l[0] == 1) {
      setAll(e.xclient.window);
    }
  }
}
