// Picture files by OpenImageIO, as image/codecs asks for them. The one room that includes it. It uses no
// other room's code, so that it can be a module that is loaded while a program runs.
#pragma once
#include <espalier/image/codecs/codecs.h>

extern "C" const espalier::PictureCodecs* espalier_openimageio_codecs();
