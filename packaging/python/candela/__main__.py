"""The command ``candela``: starts the program with the same arguments."""

import os
import subprocess
import sys

from ._session import program


def main() -> int:
    command = [str(program()), *sys.argv[1:]]
    if os.name == "posix":
        os.execv(command[0], command)
    try:
        return subprocess.call(command)
    except KeyboardInterrupt:  # The program has received it, too
        return 130


if __name__ == "__main__":
    sys.exit(main())
