"""An object store with the interface of S3, served on this machine."""

import subprocess
import sys
import time
from contextlib import contextmanager
from pathlib import Path

import pyarrow.fs

BUCKET = "robots"


@contextmanager
def bucket(port):
    """A filesystem of pyarrow on a store with the bucket `robots`; other processes of this machine reach it too."""
    server = subprocess.Popen(
        [sys.executable, "-m", "moto.server", "--host", "127.0.0.1", "--port", str(port)],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    try:
        s3 = pyarrow.fs.S3FileSystem(
            access_key="any",
            secret_key="any",
            endpoint_override=f"http://127.0.0.1:{port}",
            region="us-east-1",
            allow_bucket_creation=True,
        )
        for _ in range(150):
            try:
                s3.create_dir(BUCKET)
                break
            except OSError:
                time.sleep(0.2)
        yield s3
    finally:
        server.terminate()
        server.wait()


def upload(folder, s3, path):
    """Puts all files below a folder into the store."""
    for file in sorted(Path(folder).rglob("*")):
        if file.is_file():
            with s3.open_output_stream(f"{path}/{file.relative_to(folder).as_posix()}") as out:
                out.write(file.read_bytes())


def download(s3, path, folder):
    """The other way round."""
    for info in s3.get_file_info(pyarrow.fs.FileSelector(path, recursive=True)):
        if info.type == pyarrow.fs.FileType.File:
            file = Path(folder) / Path(info.path).relative_to(path)
            file.parent.mkdir(parents=True, exist_ok=True)
            with s3.open_input_stream(info.path, compression=None) as content:
                file.write_bytes(content.read())
