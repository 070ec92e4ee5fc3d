#include "welkin/gpu/context.h"

#include <glad/egl.h>
#include <glad/gl.h>

#include <charconv>
#include <cstring>
#include <mutex>
#include <optional>

#include "welkin/core/log.h"

namespace welkin::gpu {
namespace {

constexpr std::size_t kKeptMessages = 16;

void GLAPIENTRY onDebugMessage(GLenum, GLenum type, GLuint, GLenum severity, GLsizei, const GLchar* text, const void* user) {
  const bool matters = severity != GL_DEBUG_SEVERITY_NOTIFICATION && type != GL_DEBUG_TYPE_OTHER && type != GL_DEBUG_TYPE_PERFORMANCE;
  if (matters) static_cast<Context*>(const_cast<void*>(user))->countMessage(text);
}

bool isSoftware(const std::string& renderer) {
  return renderer.find("llvmpipe") != std::string::npos || renderer.find("softpipe") != std::string::npos ||
         renderer.find("SwiftShader") != std::string::npos;
}

std::string text(GLenum name) {
  const auto* s = reinterpret_cast<const char*>(glGetString(name));
  return s ? s : "";
}

struct Candidate {
  EGLenum platform;
  void* native;
  std::string what;
};

// Hardware devices first, then the surfaceless platform, then Mesa's software device.
std::vector<Candidate> candidates(const std::string& choice) {
  std::vector<Candidate> hardware, software, result;
  EGLDeviceEXT devices[16];
  EGLint count = 0;
  if (eglQueryDevicesEXT && eglQueryDevicesEXT(16, devices, &count)) {
    for (EGLint i = 0; i < count; ++i) {
      const char* extensions = eglQueryDeviceStringEXT ? eglQueryDeviceStringEXT(devices[i], EGL_EXTENSIONS) : nullptr;
      const bool soft = extensions && std::strstr(extensions, "EGL_MESA_device_software");
      (soft ? software : hardware).push_back({EGL_PLATFORM_DEVICE_EXT, devices[i], "device " + std::to_string(i)});
    }
  }
  int index = -1;
  std::from_chars(choice.data(), choice.data() + choice.size(), index);
  if (index >= 0) {
    if (index < count) result.push_back({EGL_PLATFORM_DEVICE_EXT, devices[index], "device " + choice});
    return result;
  }
  if (choice != "software") result = hardware;
  if (choice != "software") result.push_back({EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, "surfaceless"});
  result.insert(result.end(), software.begin(), software.end());
  if (choice == "software") result.push_back({EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, "surfaceless"});
  return result;
}

// The entry points are the same for all contexts: they are looked up once, and never while another thread calls them.
bool haveGl() {
  static std::once_flag loaded;
  std::call_once(loaded, [] { gladLoaderLoadGL(); });
  GLint major = 0, minor = 0;
  if (!glad_glGetIntegerv) return false;
  glGetIntegerv(GL_MAJOR_VERSION, &major);
  glGetIntegerv(GL_MINOR_VERSION, &minor);
  return GLAD_GL_VERSION_4_5 && major * 10 + minor >= 45;
}

struct Opened {
  EGLDisplay display;
  EGLContext context;
};

std::optional<Opened> open(const Candidate& candidate, bool debug) {
  EGLDisplay display = eglGetPlatformDisplayEXT ? eglGetPlatformDisplayEXT(candidate.platform, candidate.native, nullptr) : EGL_NO_DISPLAY;
  if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr)) return std::nullopt;
  gladLoaderLoadEGL(display);
  const EGLint configAttributes[] = {EGL_SURFACE_TYPE, EGL_DONT_CARE, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint configs = 0;
  if (!eglBindAPI(EGL_OPENGL_API) || !eglChooseConfig(display, configAttributes, &config, 1, &configs)) return std::nullopt;
  const EGLint contextAttributes[] = {EGL_CONTEXT_MAJOR_VERSION, 4, EGL_CONTEXT_MINOR_VERSION, 5, EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_CONTEXT_OPENGL_DEBUG, debug ? EGL_TRUE : EGL_FALSE, EGL_NONE};
  EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, contextAttributes);
  if (context == EGL_NO_CONTEXT) return std::nullopt;
  if (!eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) {
    eglDestroyContext(display, context);
    return std::nullopt;
  }
  return Opened{display, context};
}

}  // namespace

Result<std::unique_ptr<Context>> Context::createHeadless(const std::string& choice, bool debug) {
  if (!gladLoaderLoadEGL(EGL_NO_DISPLAY)) return Error{"EGL: libEGL.so.1 could not be loaded; install libegl1"};
  for (const Candidate& candidate : candidates(choice)) {
    const auto opened = open(candidate, debug);
    if (!opened) continue;
    if (!haveGl()) {
      eglMakeCurrent(opened->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
      eglDestroyContext(opened->display, opened->context);
      continue;
    }
    auto context = std::unique_ptr<Context>(new Context);
    context->display_ = opened->display;
    context->context_ = opened->context;
    context->begin(debug);
    return context;
  }
  return Error{"EGL: no device '" + choice + "' gives an OpenGL 4.5 core context; install a driver, or Mesa's software one (libgl1-mesa-dri)"};
}

Result<std::unique_ptr<Context>> Context::ofCurrent() {
  if (!haveGl()) return Error{"OpenGL 4.5 is needed; this machine gives " + (glad_glGetString ? text(GL_VERSION) : std::string("none"))};
  auto context = std::unique_ptr<Context>(new Context);
  context->begin(true);
  return context;
}

void Context::begin(bool debug) {
  device_ = {text(GL_RENDERER), text(GL_VERSION), text(GL_VENDOR), isSoftware(text(GL_RENDERER))};
  if (debug) {
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(onDebugMessage, this);
  }
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
}

Context::~Context() {
  if (!context_) return;  // somebody else's
  // The display is left initialised: terminating it unloads the driver while other contexts of the process may still use it.
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
}

void Context::letGo() {
  const char* nothing = "#version 450 core\nlayout(local_size_x = 1) in;\nvoid main() {}\n";
  const GLuint program = glCreateShaderProgramv(GL_COMPUTE_SHADER, 1, &nothing);
  glUseProgram(program);
  glDispatchCompute(1, 1, 1);
  glUseProgram(0);
  glDeleteProgram(program);
  glFinish();
}

void Context::countMessage(std::string message) {
  ++debugMessages_;
  if (messages_.size() >= kKeptMessages) return;
  log::warn("GL: {}", message);
  messages_.push_back(std::move(message));
}

}  // namespace welkin::gpu
