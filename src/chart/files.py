"""Files are written beside their place and renamed, so that nobody finds half of one."""


def write_whole(path, text):
    part = path.with_name(f".{path.name}.tmp")
    try:
        part.write_text(text, encoding="utf-8", newline="")
        part.replace(path)
    except (OSError, UnicodeError):
        part.unlink(missing_ok=True)
        raise
