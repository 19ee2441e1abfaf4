// The functions of OpenGL 4.5 that the renderer calls, looked up at run time: which library answers is not
// known when the program is linked, and the process may hold several.
#pragma once

#include <GL/glcorearb.h>

#include <functional>

#include "raster/gl/gl_backend.h"

namespace chironomia {

// type without PFNGL...PROC, name without gl
#define CHIRONOMIA_GL_FUNCTIONS(X)                                    \
    X(ACTIVETEXTURE, ActiveTexture)                                   \
    X(ATTACHSHADER, AttachShader)                                     \
    X(BINDATTRIBLOCATION, BindAttribLocation)                         \
    X(BINDBUFFER, BindBuffer)                                         \
    X(BINDFRAMEBUFFER, BindFramebuffer)                               \
    X(BINDRENDERBUFFER, BindRenderbuffer)                             \
    X(BINDTEXTURE, BindTexture)                                       \
    X(BINDVERTEXARRAY, BindVertexArray)                               \
    X(BLENDFUNCSEPARATE, BlendFuncSeparate)                           \
    X(BLITFRAMEBUFFER, BlitFramebuffer)                               \
    X(BUFFERDATA, BufferData)                                         \
    X(BUFFERSUBDATA, BufferSubData)                                   \
    X(CHECKFRAMEBUFFERSTATUS, CheckFramebufferStatus)                 \
    X(CLEAR, Clear)                                                   \
    X(CLEARCOLOR, ClearColor)                                         \
    X(COMPILESHADER, CompileShader)                                   \
    X(CREATEPROGRAM, CreateProgram)                                   \
    X(CREATESHADER, CreateShader)                                     \
    X(CULLFACE, CullFace)                                             \
    X(DELETEBUFFERS, DeleteBuffers)                                   \
    X(DELETEFRAMEBUFFERS, DeleteFramebuffers)                         \
    X(DELETEPROGRAM, DeleteProgram)                                   \
    X(DELETERENDERBUFFERS, DeleteRenderbuffers)                       \
    X(DELETESHADER, DeleteShader)                                     \
    X(DELETETEXTURES, DeleteTextures)                                 \
    X(DELETEVERTEXARRAYS, DeleteVertexArrays)                         \
    X(DEPTHFUNC, DepthFunc)                                           \
    X(DEPTHMASK, DepthMask)                                           \
    X(DISABLE, Disable)                                               \
    X(DRAWELEMENTS, DrawElements)                                     \
    X(ENABLE, Enable)                                                 \
    X(ENABLEVERTEXATTRIBARRAY, EnableVertexAttribArray)               \
    X(DISABLEVERTEXATTRIBARRAY, DisableVertexAttribArray)             \
    X(FRAMEBUFFERRENDERBUFFER, FramebufferRenderbuffer)               \
    X(FRONTFACE, FrontFace)                                           \
    X(GENBUFFERS, GenBuffers)                                         \
    X(GENERATEMIPMAP, GenerateMipmap)                                 \
    X(GENFRAMEBUFFERS, GenFramebuffers)                               \
    X(GENRENDERBUFFERS, GenRenderbuffers)                             \
    X(GENTEXTURES, GenTextures)                                       \
    X(GENVERTEXARRAYS, GenVertexArrays)                               \
    X(GETERROR, GetError)                                             \
    X(GETINTEGERV, GetIntegerv)                                       \
    X(GETPROGRAMINFOLOG, GetProgramInfoLog)                           \
    X(GETPROGRAMIV, GetProgramiv)                                     \
    X(GETSHADERINFOLOG, GetShaderInfoLog)                             \
    X(GETSHADERIV, GetShaderiv)                                       \
    X(GETSTRING, GetString)                                           \
    X(GETUNIFORMLOCATION, GetUniformLocation)                         \
    X(LINKPROGRAM, LinkProgram)                                       \
    X(PIXELSTOREI, PixelStorei)                                       \
    X(READPIXELS, ReadPixels)                                         \
    X(RENDERBUFFERSTORAGEMULTISAMPLE, RenderbufferStorageMultisample) \
    X(SCISSOR, Scissor)                                               \
    X(SHADERSOURCE, ShaderSource)                                     \
    X(TEXIMAGE2D, TexImage2D)                                         \
    X(TEXPARAMETERI, TexParameteri)                                   \
    X(TEXSUBIMAGE2D, TexSubImage2D)                                   \
    X(UNIFORM1F, Uniform1f)                                           \
    X(UNIFORM1I, Uniform1i)                                           \
    X(UNIFORM3FV, Uniform3fv)                                         \
    X(UNIFORM4FV, Uniform4fv)                                         \
    X(UNIFORMMATRIX4FV, UniformMatrix4fv)                             \
    X(USEPROGRAM, UseProgram)                                         \
    X(VERTEXATTRIB4F, VertexAttrib4f)                                 \
    X(VERTEXATTRIBPOINTER, VertexAttribPointer)                       \
    X(VIEWPORT, Viewport)

struct GlFunctions {
#define CHIRONOMIA_GL_MEMBER(type, name) PFNGL##type##PROC name = nullptr;
    CHIRONOMIA_GL_FUNCTIONS(CHIRONOMIA_GL_MEMBER)
#undef CHIRONOMIA_GL_MEMBER
};

// Throws Error naming the first function that `find` does not know.
GlFunctions load_gl_functions(const std::function<GlAddress(const char*)>& find);

}  // namespace chironomia
