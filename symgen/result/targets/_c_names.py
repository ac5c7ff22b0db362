"""Name of a mechanism in C: the type, the files, and the beginning of all functions that a program sees."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import lru_cache

from symgen.base.files import templates_folder
from symgen.compile.native.c99_words import RESERVED

#: What `stdio.h`, `stdlib.h`, `string.h`, `math.h`, `stdint.h` and `stdbool.h` of common libraries declare further.
_DECLARED = frozenset(
    (
        "a64l aligned_alloc alloca arc4random arc4random_buf arc4random_uniform asprintf at_quick_exit atexit atol "
        "basename bcmp bcopy be16toh be32toh be64toh bool bsearch bzero calloc canonicalize canonicalize_file_name "
        "clearenv clearerr ctermid cuserid daddl ddivl dfmal dmull dprintf drand48 drand48_data dsqrtl dsubl ecvt "
        "erand48 exp10 explicit_bzero fadd false fclose fcloseall fcvt fd_mask fd_set fdiv fdopen feof ferror "
        "fflush ffma ffs ffsl fgetc fgetpos fgets fileno flockfile fmaximum fmaximum_mag fmaximum_mag_num "
        "fmaximum_num fmaxmag fmemopen fminimum fminimum_mag fminimum_mag_num fminimum_num fminmag fmul fopen "
        "fopencookie fpclassify fprintf fputc fputs fread free freopen fromfp fromfpx fscanf fseek fseeko fsetpos "
        "fsqrt fsub ftell ftello ftrylockfile funlockfile fwrite gcvt getc getchar getdelim getenv getline "
        "getloadavg getpayload getpt gets getsubopt getw grantpt htobe16 htobe32 htole16 htole32 initstate "
        "iscanonical iseqsig isgreater isgreaterequal isless islessequal islessgreater isnormal issignaling "
        "issubnormal isunordered iszero jrand48 l64a lcong48 ldiv le16toh le32toh le64toh llabs lldiv llogb lrand48 "
        "malloc math_errhandling mblen mbstowcs mbtowc mkdtemp mkostemp mkostemps mkstemp mkstemps mktemp mrand48 "
        "nextdown nextup nrand48 obstack obstack_printf obstack_vprintf offsetof on_exit open_memstream pclose "
        "perror popen posix_memalign posix_openpt pselect ptsname putc putchar putenv puts putw qecvt qfcvt qgcvt "
        "qsort quick_exit rand random random_data rawmemchr realloc reallocarray realpath remove rename renameat "
        "renameat2 rewind rindex roundeven rpmatch scanf secure_getenv seed48 select setbuf setbuffer setenv "
        "setlinebuf setpayload setpayloadsig setstate setvbuf signbit snprintf sprintf srand srand48 srandom sscanf "
        "stderr stdin stdout stpcpy stpncpy tempnam timespec timeval tmpfile tmpnam totalorder totalordermag true "
        "u_char u_int u_long u_short ufromfp ufromfpx uint ulong ungetc unlockpt unsetenv ushort va_list valloc "
        "vasprintf vdprintf vfprintf vfscanf vprintf vscanf vsnprintf vsprintf vsscanf wctomb"
    ).split()
)
#: Names that standards keep for libraries: of types, of functions for texts and memory, of mathematics.
_KEPT = re.compile(r".*_[trl]|(str|mem|wcs)[a-z0-9]+|.*_(unlocked|np)|.*64|f(32|64|128)[a-z0-9]+")
_PRECISION = re.compile(r"(f|l|f32x?|f64x?|f128)$")
#: Functions and macros with arguments, arrays without a size, types.
_DEFINED = re.compile(r"\b([A-Za-z]\w*) ?\(|\b([A-Za-z]\w*)\[\]|^(?:typedef [^;{]*\b|\} )(\w+);", re.MULTILINE)
_PREFIX = re.compile(r"\{\{ (prefix|upper) \}\}")
#: Text that names nothing; what is exported gets a prefix.
_NO_CODE = re.compile(r"EXPORT\([A-Z]\w*\)|\{[%#{].*?[%#}]\}|/\*.*?\*/|//[^\n]*|\"(?:\\.|[^\"\\\n])*\"", re.DOTALL)


def prefix_of(name: str, functions: str) -> str:
    """Return a name that collides with no name of C, of its library, or of emitted code.

    A name that does is followed by ``_model``.

    Parameters
    ----------
    name : str
        Name of the mechanism.
    functions : str
        Emitted functions in C.
    """
    prefix, others = name.replace("-", "_"), _of_templates() | _words(functions)
    while _is_taken(prefix, others):
        prefix += "_model"
    return prefix


def _is_taken(prefix: str, names: frozenset[str]) -> bool:
    """Whether a prefix is another name, or the beginning of one."""
    base = _PRECISION.sub("", prefix)
    return (
        not {prefix, base}.isdisjoint(RESERVED | _DECLARED)
        or _KEPT.fullmatch(prefix) is not None
        or any(name == prefix or name.startswith(f"{prefix}_") for name in names)
    )


@lru_cache(maxsize=1)
def defined_names() -> frozenset[str]:
    """Return the functions, types and arrays that the templates of both targets have: no printed function is one."""
    texts = (_NO_CODE.sub(" ", text) for text in _templates())
    return frozenset(next(filter(None, names)) for text in texts for names in _DEFINED.findall(text))


@lru_cache(maxsize=1)
def _of_templates() -> frozenset[str]:
    """Return the names in the templates, in all files of both targets."""
    return frozenset().union(*map(_words, _templates()))


def _templates() -> Iterator[str]:
    for path in sorted((templates_folder() / "c").glob("*.[ch].j2")):
        yield _PREFIX.sub("_", path.read_text(encoding="utf-8"))


def _words(text: str) -> frozenset[str]:
    """Return the names in a text of C; capital letters do not count, as names of constants have them."""
    return frozenset(re.findall(r"\b[a-z]\w*", _NO_CODE.sub(" ", text).lower()))
