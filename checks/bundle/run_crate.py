"""Validates ro-crate-metadata.json in the current folder as a Workflow Run RO-Crate: all requirements of the profile and
of those it extends, by roc-validator. Exit code 0 when it is valid.

The validator fetches the context of RO-Crate 1.1 from w3id.org, each time and in two ways. Here it gets the copy that the
package `rocrate` brings along, so that the verdict needs no network."""

import email.message
import io
import sys
import urllib.request
import urllib.response
from importlib.metadata import files

import requests.adapters

ADDRESS = "https://w3id.org/ro/crate/1.1/context"
KIND = "application/ld+json"
CONTEXT = next(file for file in files("rocrate") if file.name == "ro-crate.jsonld").locate().read_bytes()
assert ADDRESS.encode() in CONTEXT, "the package rocrate has the context of another version"


class Known(urllib.request.BaseHandler):
    """For rdflib, which reads through urllib."""

    handler_order = 100

    def https_open(self, request):
        if request.full_url != ADDRESS:
            return None
        head = email.message.Message()
        head["Content-Type"] = KIND
        response = urllib.response.addinfourl(io.BytesIO(CONTEXT), head, ADDRESS, 200)
        response.msg = "OK"
        return response


def send(self, request, *arguments, **named):
    """For the validator itself, which reads through requests."""
    if request.url != ADDRESS:
        return SEND(self, request, *arguments, **named)
    response = requests.Response()
    response.status_code, response.url, response.request = 200, ADDRESS, request
    response.headers["Content-Type"] = KIND
    response._content = CONTEXT
    return response


SEND = requests.adapters.HTTPAdapter.send
requests.adapters.HTTPAdapter.send = send
urllib.request.install_opener(urllib.request.build_opener(Known()))

from rocrate_validator.cli import cli  # noqa: E402, it opens its session when it is imported

sys.argv[1:] = ["-y", "--disable-color", "validate", "--no-cache", "--profile-identifier", "workflow-run-crate", *sys.argv[1:], "."]
cli()
