"""The command ``candela``: starts the program with the same arguments."""

import os
import subprocess
import sys
from typing import Union

from ._errors import CandelaError
from ._session import program, program_environment


def main() -> Union[int, str]:
    try:
        path, environment = program(), program_environment()
        command = [str(path), *sys.argv[1:]]
        if os.name == "posix":
            os.execve(path, command, environment)
        return subprocess.call(command, env=environment)
    except KeyboardInterrupt:  # The program has received it, too
        return 130
    except (CandelaError, OSError) as e:
        return f"candela: {e}"


if __name__ == "__main__":
    sys.exit(main())
