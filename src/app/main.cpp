#include "welkin/app/cli.h"

int main(int argc, char** argv) { return welkin::app::runProgram(argc, argv); }
