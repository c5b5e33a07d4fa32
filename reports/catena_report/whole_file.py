"""Files that are written whole or not at all."""
import os
import pathlib


def write(path, content):
    """The file `path` gets this text (as UTF-8, with its line ends as they are) or these bytes. What was there before
    stays until all is written; a link stays, and the file it points to is replaced. An OSError names the file.
    """
    data = content if isinstance(content, bytes) else content.encode("utf-8")
    target = pathlib.Path(os.path.realpath(path))
    unfinished = target.with_name(f"{target.name}.{os.getpid()}.unfinished")
    try:
        if target.exists() and not target.is_file():  # a device, a FIFO: written through
            target.write_bytes(data)
            return
        try:
            unfinished.write_bytes(data)
            unfinished.replace(target)
        finally:
            unfinished.unlink(missing_ok=True)
    except OSError as error:
        raise OSError(error.errno, error.strerror, str(path)) from None
