// Compiled into programs that use an installed Welkin: the shaders lie beside this file, wherever the installation was moved
// to. Weak, because a program and the libraries that it links may each bring a copy.
extern "C" __attribute__((weak)) const char* welkinFileBesideShaders() { return __FILE__; }
