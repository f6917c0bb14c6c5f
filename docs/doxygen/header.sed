# The lines // that open a file become its description for Doxygen.
1s|^//|/// @file\n///|
2,/^[^\/]/s|^// |/// |
